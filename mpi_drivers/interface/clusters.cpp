// coseg::cluster.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <coseg/coseg.hpp>
#include <utility>

#include "io/files/content_hash.hpp"
#include "mpi_drivers/clustering.hpp"
#include "mpi_drivers/interface/certificates.hpp"
#include "mpi_drivers/interface/collection_shapes.hpp"
#include "mpi_drivers/interface/library_call.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

namespace {

[[noreturn]] void refuse_setting(const std::string& sentence) { throw Error(ExitCode::usage, sentence); }

template <NamedEnum E>
E enumerator(const std::string& what, const std::string& name) {
    if (const auto value = named<E>(name)) return *value;
    std::string names;
    for (const std::string& known : names_of<E>()) names += (names.empty() ? "" : ", ") + known;
    refuse_setting(what + ": '" + name + "' is none of " + names);
}

void refuse_outside(const char* what, double value, double least, double most) {
    if (value >= least && value <= most) return;
    refuse_setting(std::string(what) + ": " + significant(value) + " is not in " + significant(least) +
                   " .. " + significant(most));
}

ClusterOptions cluster_options(const ClusterSettings& given) {
    refuse_outside("parts", given.parts, 1, most_parts);
    if (given.links < 0 || given.links == 1) refuse_setting("links: 0, or at least 2 groups");
    refuse_outside("alpha", given.alpha, 0.0, most_penalty);
    refuse_outside("beta", given.beta, 0.0, most_penalty);
    refuse_outside("lambda", given.lambda, 0.0, most_penalty);
    refuse_outside("gap", given.gap, least_gap, 1.0);
    refuse_outside("max_iterations", given.max_iterations, 1.0, most_solve_iterations);
    refuse_outside("max_seconds", given.max_seconds, 0.0, most_solve_seconds);
    ClusterOptions options;
    options.parts = given.parts;
    options.unit_columns = given.unit_items;
    options.variant = enumerator<SubspaceVariant>("variant", given.variant);
    options.scope = enumerator<ClusterScope>("scope", given.scope);
    options.affinity = enumerator<AffinityForm>("affinity", given.affinity);
    options.links = given.links;
    options.seed = given.seed;
    options.alpha = given.alpha;
    options.beta = given.beta;
    options.lambda = given.lambda;
    options.solve.gap = given.gap;
    options.solve.max_iterations = given.max_iterations;
    options.solve.max_seconds = given.max_seconds;
    return options;
}

void refuse_bad_groups(const std::vector<int>& groups, std::size_t items) {
    if (groups.empty()) return;
    if (groups.size() != items)
        throw Error(ExitCode::input, "groups: there are " + std::to_string(groups.size()) + " for " +
                                         std::to_string(items) + " items");
    for (std::size_t k = 0; k < groups.size(); ++k) {
        if (groups[k] < 0 || at(groups[k]) >= items)
            throw Error(ExitCode::input, "groups: item " + std::to_string(k) + " is in group " +
                                             std::to_string(groups[k]) + "; groups are counted from 0");
    }
}

/// A feature of a caller, item by item, is a matrix of ours column by column.
ClusterData cluster_data(const std::vector<FeatureMatrix>& features, const ClusterSettings& given) {
    ClusterData data;
    data.name = "the matrices";
    if (features.empty()) throw Error(ExitCode::input, "no feature is given; give at least one matrix");
    for (std::size_t h = 0; h < features.size(); ++h) {
        const auto [values, dimensions] = features[h];
        if (dimensions < 1 || values.size() % at(dimensions) != 0)
            throw Error(ExitCode::input, "feature " + std::to_string(h + 1) + ": " +
                                             std::to_string(values.size()) + " values are no rows of " +
                                             std::to_string(dimensions));
        data.file.names.push_back(std::to_string(h + 1));
        data.file.features.emplace_back(Eigen::Map<const Eigen::MatrixXd>(
            values.data(), dimensions, static_cast<Eigen::Index>(values.size()) / dimensions));
    }
    data.file.mesh_of = given.groups;
    refuse_bad_groups(given.groups, at(data.file.features.front().cols()));
    return data;
}

ContentHash content_of(const std::vector<FeatureMatrix>& features, const std::vector<int>& groups) {
    ContentHasher hasher;
    for (const FeatureMatrix& feature : features) hasher.add(feature.values);
    hasher.add(std::span<const int>(groups));
    return hasher.result();
}

ContentHash content_of(const ClusterSettings& given) {
    ContentHasher hasher;
    for (const int number : {given.parts, given.links, given.max_iterations}) hasher.add(number);
    for (const double number : {given.alpha, given.beta, given.lambda, given.gap, given.max_seconds})
        hasher.add(number);
    for (const std::string* text : {&given.variant, &given.scope, &given.affinity}) hasher.add(*text);
    hasher.add(given.unit_items);
    hasher.add(given.seed);
    return hasher.result();
}

/// W of each feature on all ranks: what is 0 for a feature is left out of its matrix. Collective.
std::vector<SparseMatrix> all_coefficients(const Comm& comm, const SparseCoefficients& local) {
    const SparseCoefficients w = all_gathered(comm, local);
    std::vector<SparseMatrix> matrices(at(w.features), {w.size, {0}, {}, {}});
    for (std::size_t c = 0; c + 1 < w.offsets.size(); ++c) {
        for (std::size_t entry = at(w.offsets[c]); entry < at(w.offsets[c + 1]); ++entry) {
            for (std::size_t h = 0; h < matrices.size(); ++h) {
                const double value = w.values[entry * matrices.size() + h];
                if (value == 0.0) continue;
                matrices[h].indices.push_back(w.rows[entry]);
                matrices[h].values.push_back(value);
            }
        }
        for (SparseMatrix& matrix : matrices) matrix.offsets.push_back(std::ssize(matrix.indices));
    }
    return matrices;
}

/// Collective.
SparseMatrix whole_affinity(const Comm& comm, const SparseCoefficients& w, AffinityForm form) {
    SparseRows rows = gather_rows(
        comm, form == AffinityForm::links ? normalized_links(comm, w) : symmetric_affinity(comm, w));
    return {rows.size, std::move(rows.offsets), std::move(rows.columns), std::move(rows.values)};
}

Clusters clustered(LibraryCall& library, const std::vector<FeatureMatrix>& features,
                   const ClusterSettings& given) {
    const Comm& comm = library.comm();
    refuse_differences(comm, content_of(given), "settings");
    ClusterOptions options;
    ClusterData data;
    agree(comm, [&] {
        options = cluster_options(given);
        data = cluster_data(features, given);
    });
    refuse_differences(comm, content_of(features, given.groups), "matrices");
    library.log().begin("optimise");
    share(comm, data);
    options.solve.progress = [&](std::int64_t done, std::int64_t all) { library.log().progress(done, all); };
    const auto [problem, solution] = solve_clusters(comm, data, options);
    library.log().end("");
    library.log().begin("cut");
    Clusters result;
    result.labels = cut_clusters(comm, data, solution, options).part_of_patch;
    library.log().end("");
    result.certificate = certificate_of(solution);
    result.report = certificate_json(problem, solution);
    result.coefficients = all_coefficients(comm, solution.coefficients);
    result.affinity = whole_affinity(comm, solution.coefficients, options.affinity);
    return result;
}

}  // namespace

Clusters interface_1::cluster(const std::vector<FeatureMatrix>& features, const ClusterSettings& settings,
                              const Call& call) {
    return in_call(call, [&](LibraryCall& library) { return clustered(library, features, settings); });
}

}  // namespace coseg
