#include "io/data_files/feature_file.hpp"

#include <algorithm>
#include <cmath>

#include "io/files/hdf5_file.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr const char* format = "coseg features";

[[noreturn]] void refuse(const std::string& path, const std::string& sentence) {
    throw Error(ExitCode::input, path + ": " + sentence);
}

void refuse_length(const std::string& path, const std::string& name, std::size_t length, std::size_t items) {
    if (length == items) return;
    refuse(path, "'" + name + "' has " + std::to_string(length) + " entries, but there are " +
                     std::to_string(items) + " items (rows of the features)");
}

bool is_size(double value) { return std::isfinite(value) && value >= 0.0; }

void refuse_repeated_pairs(const std::string& path, const std::string& group, const ItemPairs& pairs) {
    std::vector<std::pair<int, int>> sorted;
    for (std::size_t k = 0; k < pairs.first.size(); ++k) sorted.emplace_back(pairs.first[k], pairs.second[k]);
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice == sorted.end()) return;
    refuse(path, "'" + group + "' has the pair of items " + std::to_string(twice->first) + " and " +
                     std::to_string(twice->second) + " twice");
}

ItemPairs read_pairs(const Hdf5Reader& reader, const std::string& group, const std::string& weight,
                     std::size_t items) {
    ItemPairs pairs;
    if (!reader.has(group)) return pairs;
    pairs.first = reader.read<std::int32_t>(group + "/first");
    pairs.second = reader.read<std::int32_t>(group + "/second");
    pairs.weight = reader.read<double>(group + "/" + weight);
    if (pairs.first.size() != pairs.second.size() || pairs.first.size() != pairs.weight.size())
        refuse(reader.path(), "the datasets of '" + group + "' are of different lengths");
    for (std::size_t k = 0; k < pairs.first.size(); ++k) {
        const bool inside =
            pairs.first[k] >= 0 && pairs.first[k] < pairs.second[k] && at(pairs.second[k]) < items;
        if (!inside || !is_size(pairs.weight[k])) {
            refuse(reader.path(), "'" + group + "', pair " + std::to_string(k) +
                                      ": needs 0 <= first < second < number of items and a finite " + weight +
                                      " of at least 0");
        }
    }
    refuse_repeated_pairs(reader.path(), group, pairs);
    return pairs;
}

void read_groups(const Hdf5Reader& reader, std::size_t items, FeatureFile& file) {
    if (reader.has("mesh_of")) {
        file.mesh_of = reader.read<std::int32_t>("mesh_of");
        refuse_length(reader.path(), "mesh_of", file.mesh_of.size(), items);
        if (std::ranges::any_of(file.mesh_of, [](int mesh) { return mesh < 0; }))
            refuse(reader.path(), "'mesh_of' holds a negative number; meshes count from 0");
        // What follows is as large as the largest number.
        const int largest = file.mesh_of.empty() ? 0 : *std::ranges::max_element(file.mesh_of);
        if (items > 0 && at(largest) >= items) {
            refuse(reader.path(), "'mesh_of' holds the number " + std::to_string(largest) +
                                      ", but there are " + std::to_string(items) +
                                      " items only; number the meshes from 0 without gaps");
        }
    }
    if (reader.has("mesh_names")) {
        file.mesh_names = reader.read_texts("mesh_names");
        const int meshes = file.mesh_of.empty() ? 0 : *std::ranges::max_element(file.mesh_of) + 1;
        if (at(meshes) != file.mesh_names.size())
            refuse(reader.path(), "'mesh_names' has " + std::to_string(file.mesh_names.size()) +
                                      " entries, but 'mesh_of' counts " + std::to_string(meshes));
    }
    if (reader.has("patch_area")) {
        file.patch_area = reader.read<double>("patch_area");
        refuse_length(reader.path(), "patch_area", file.patch_area.size(), items);
        if (!std::ranges::all_of(file.patch_area, is_size))
            refuse(reader.path(), "'patch_area' holds a value that is not a finite number of at least 0");
    }
}

/// A mean of values in [0, 1] may leave it by rounding.
void read_concavity(const Hdf5Reader& reader, FeatureFile& file) {
    constexpr double rounding = 1e-9;
    file.concavity = reader.read<double>("neighbors/concavity");
    if (file.concavity.size() != file.neighbors.first.size())
        refuse(reader.path(), "the datasets of 'neighbors' are of different lengths");
    const auto in_range = [](double value) { return value >= -rounding && value <= 1.0 + rounding; };
    if (!std::ranges::all_of(file.concavity, in_range))
        refuse(reader.path(), "'neighbors/concavity' holds a value that is not in [0, 1]");
}

void write_pairs(Hdf5Writer& writer, const std::string& group, const std::string& weight,
                 const ItemPairs& pairs) {
    writer.write(group + "/first", std::vector<std::int32_t>(pairs.first.begin(), pairs.first.end()));
    writer.write(group + "/second", std::vector<std::int32_t>(pairs.second.begin(), pairs.second.end()));
    writer.write(group + "/" + weight, pairs.weight);
}

}  // namespace

FeatureFile read_feature_file(const std::string& path) {
    const Hdf5Reader reader(path, Hdf5Origin::foreign);
    if (!reader.has("features")) refuse(path, "has no group 'features'; see docs/formats.md for the layout");
    FeatureFile file;
    file.names = reader.names("features");
    if (file.names.empty()) refuse(path, "the group 'features' is empty; give at least one matrix");
    for (const std::string& name : file.names)
        file.features.push_back(reader.read_matrix("features/" + name));
    const auto items = at(file.features.front().cols());
    read_groups(reader, items, file);
    file.neighbors = read_pairs(reader, "neighbors", "boundary_length", items);
    if (!file.neighbors.first.empty()) read_concavity(reader, file);
    file.overlaps = read_pairs(reader, "overlaps", "intersection_over_union", items);
    return file;
}

void write_feature_file(const std::string& path, const FeatureFile& file) {
    Hdf5Writer writer(path, format, 1);
    for (std::size_t h = 0; h < file.features.size(); ++h)
        writer.write_matrix("features/" + file.names[h], file.features[h]);
    if (!file.mesh_of.empty())
        writer.write("mesh_of", std::vector<std::int32_t>(file.mesh_of.begin(), file.mesh_of.end()));
    if (!file.mesh_names.empty()) writer.write_texts("mesh_names", file.mesh_names);
    if (!file.patch_area.empty()) writer.write("patch_area", file.patch_area);
    if (!file.neighbors.first.empty()) {
        write_pairs(writer, "neighbors", "boundary_length", file.neighbors);
        writer.write("neighbors/concavity", file.concavity);
    }
    if (!file.overlaps.first.empty())
        write_pairs(writer, "overlaps", "intersection_over_union", file.overlaps);
    writer.commit();
}

void write_coefficient_file(const std::string& path, const CoefficientFile& file) {
    Hdf5Writer writer(path, "coseg coefficients", 1);
    writer.attribute("size", file.size);
    writer.attribute("objective", file.objective);
    writer.attribute("lower_bound", file.lower_bound);
    writer.attribute("reason", file.reason);
    writer.write("offsets", file.offsets);
    writer.write("rows", std::vector<std::int32_t>(file.rows.begin(), file.rows.end()));
    writer.write("values", file.values, {file.rows.size(), static_cast<std::uint64_t>(file.features)});
    writer.commit();
}

}  // namespace coseg
