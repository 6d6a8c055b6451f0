#include "mpi_drivers/interface/collection_shapes.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

#include "io/interface/shape_polygons.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

constexpr std::size_t longest_name = 251;  // a file's name has 255 bytes, with a suffix such as .seg

std::string standard_name(std::size_t index) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "shape_%04zu", index);
    return text.data();
}

void refuse_bad_name(const MeshEntry& entry, std::size_t index) {
    const std::string& name = entry.name;
    const bool is_bad = name.empty() || name.size() > longest_name || name == "." || name == ".." ||
                        std::any_of(name.begin(), name.end(), [](char c) { return c == '/' || c == '\0'; });
    if (is_bad)
        throw Error(ExitCode::usage, "shape " + std::to_string(index) +
                                         ": its name must be that of a file: not empty, without '/', of at "
                                         "most 251 bytes");
}

MeshEntry file_entry(const Shape& shape, std::size_t index) {
    if (!shape.vertices.empty() || !shape.corners.empty())
        throw Error(ExitCode::usage,
                    "shape " + std::to_string(index) + ": give a path or arrays, and not both");
    const std::vector<MeshEntry> found = expand_mesh_list({shape.path});
    if (found.size() != 1 || found.front().path != shape.path)
        throw Error(ExitCode::input, shape.path + ": is no mesh file; mesh_files() lists those of a folder");
    MeshEntry entry = found.front();
    if (!shape.name.empty()) entry.name = shape.name;
    return entry;
}

void add_content(ContentHasher& hasher, const Shape& shape) {
    hasher.add(shape.name);
    hasher.add(shape.path);
    hasher.add(shape.vertices);
    hasher.add(shape.corners);
    hasher.add(shape.offsets);
}

void refuse_equal_names(const std::vector<MeshEntry>& entries) {
    for (std::size_t k = 1; k < entries.size(); ++k) {
        if (entries[k].name != entries[k - 1].name) continue;
        throw Error(ExitCode::usage, "two shapes are named '" + entries[k].name +
                                         "': " + entries[k - 1].path + " and " + entries[k].path +
                                         "; give them names of their own");
    }
}

}  // namespace

CollectionShapes::CollectionShapes(const Comm& comm, std::span<const Shape> shapes) {
    std::vector<MeshEntry> entries;
    ContentHasher hasher;
    agree(comm, [&] {
        if (shapes.empty()) throw Error(ExitCode::usage, "no shape is given; give at least one");
        for (const Shape& shape : shapes) views_.push_back({shape.vertices, shape.corners, shape.offsets});
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            const Shape& shape = shapes[s];
            if (comm.size() > 1) add_content(hasher, shape);
            if (!shape.path.empty()) {
                entries.push_back(file_entry(shape, s));
            } else {
                const std::uintmax_t bytes = shape.vertices.size_bytes() + shape.corners.size_bytes();
                entries.push_back({shape.name.empty() ? standard_name(s) : shape.name, called(shape, s),
                                   bytes, &views_[s]});
            }
            refuse_bad_name(entries.back(), s);
        }
    });
    refuse_differences(comm, hasher.result(), "shapes");
    order_.resize(entries.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return entries[a].name < entries[b].name; });
    for (const std::size_t s : order_) entries_.push_back(std::move(entries[s]));
    agree(comm, [&] { refuse_equal_names(entries_); });
}

void add_options(ContentHasher& hasher, const std::vector<Option>& options) {
    for (const auto& [name, value] : options) {
        hasher.add(name);
        hasher.add(value);
    }
}

void refuse_differences(const Comm& comm, const ContentHash& hash, const std::string& what) {
    ContentHash of_root = hash;
    broadcast(comm, of_root);
    agree(comm, [&] {
        if (!(of_root == hash))
            throw Error(ExitCode::usage, "rank " + std::to_string(comm.rank()) + " was given other " + what +
                                             " than rank 0; give every rank the same");
    });
}

}  // namespace coseg
