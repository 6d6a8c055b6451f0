#include "mpi_drivers/results/output_stage.hpp"

#include <sys/resource.h>

#include "io/data_files/label_file.hpp"
#include "io/data_files/result_files.hpp"
#include "io/files/content_hash.hpp"
#include "io/mesh_files/ply_format.hpp"
#include "io/reports/affinity_image.hpp"
#include "io/reports/png_writer.hpp"
#include "io/reports/report.hpp"
#include "mpi_drivers/process/version.hpp"
#include "solvers/affinity/affinity_picture.hpp"
#include "solvers/partition/part_count.hpp"
#include "solvers/subspace/feature_strength.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

constexpr int affinity_bins = 96;
constexpr int picture_bins = 480;

double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts KiB
}

/// parts x meshes: shares of area, on all ranks.
Eigen::MatrixXd gather_part_areas(const Comm& comm, const RunOutcome& outcome) {
    const auto meshes = static_cast<Eigen::Index>(outcome.collection.meshes.size());
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(outcome.parts, meshes);
    for (const MeshLabels& labels : outcome.labels) {
        for (Eigen::Index p = 0; p < shares.rows(); ++p) shares(p, labels.mesh) = labels.part_area[at(p)];
    }
    MPI_Allreduce(MPI_IN_PLACE, shares.data(), static_cast<int>(shares.size()), MPI_DOUBLE, MPI_SUM,
                  comm.raw());
    return shares;
}

std::vector<double> to_vector(const Eigen::VectorXd& values) {
    return {values.data(), values.data() + values.size()};
}

struct LabelChecksums {
    int mesh = 0;
    std::string labels;
    std::string patches;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &LabelChecksums::mesh), field("labels", &LabelChecksums::labels),
                          field("patches", &LabelChecksums::patches));
    }
};

/// Of each mesh's label files, on all ranks.
std::vector<LabelChecksums> gather_checksums(const Comm& comm, const RunOutcome& outcome) {
    std::vector<LabelChecksums> mine;
    for (const MeshLabels& labels : outcome.labels)
        mine.push_back({labels.mesh, hash_bytes(label_text(labels.part)).hex(),
                        hash_bytes(label_text(labels.patch)).hex()});
    std::vector<LabelChecksums> all(outcome.collection.meshes.size());
    for (LabelChecksums& row : all_gather_records(comm, mine)) all[at(row.mesh)] = std::move(row);
    return all;
}

/// The mean confidence of each mesh over its area, on all ranks; empty where none is known.
std::vector<double> gather_confidence(const Comm& comm, const RunOutcome& outcome) {
    if (outcome.cut.confidence.empty()) return {};
    std::vector<double> means(outcome.collection.meshes.size(), 0.0);
    for (std::size_t k = 0; k < outcome.labels.size(); ++k) {
        const MeshLabels& labels = outcome.labels[k];
        const MeshDescription& mesh = outcome.collection.local[k];
        for (std::size_t f = 0; f < mesh.map.input_face.size(); ++f)
            means[at(labels.mesh)] += mesh.geometry.area[static_cast<Eigen::Index>(f)] *
                                      static_cast<double>(labels.confidence[at(mesh.map.input_face[f])]);
    }
    MPI_Allreduce(MPI_IN_PLACE, means.data(), static_cast<int>(means.size()), MPI_DOUBLE, MPI_SUM,
                  comm.raw());
    // Shares of an area sum to 1 but for rounding.
    for (double& mean : means) mean = std::min(mean, 1.0);
    return means;
}

std::vector<ReportMesh> report_meshes(const RunOutcome& outcome, const Eigen::MatrixXd& part_areas,
                                      const std::vector<double>& confidence,
                                      const std::vector<LabelChecksums>& checksums) {
    std::vector<ReportMesh> rows;
    for (std::size_t m = 0; m < outcome.collection.meshes.size(); ++m) {
        const auto number = static_cast<int>(m);
        const MeshFacts& facts = outcome.collection.meshes[m];
        rows.push_back({.facts = facts,
                        .patches = outcome.collection.numbering.count(number),
                        .part_area = to_vector(part_areas.col(number)),
                        .confidence = confidence.empty() ? std::optional<double>() : confidence[m],
                        .labels_xxh3 = checksums[m].labels,
                        .patches_xxh3 = checksums[m].patches,
                        .name_bytes = hex_unless_utf8(facts.name),
                        .path_bytes = hex_unless_utf8(facts.path)});
    }
    return rows;
}

void add_strengths(ReportFeatures& report, const FeatureStrength& strength, const RunOutcome& outcome) {
    for (std::size_t h = 0; h < strength.overall.size(); ++h) {
        ReportStrength row{
            .feature = outcome.optimisation.features[h], .overall = strength.overall[h], .within_part = {}};
        for (const std::vector<double>& part : strength.of_part) row.within_part.push_back(part[h]);
        report.strengths.push_back(std::move(row));
    }
    report.inside_part = strength.inside;
    report.coefficient_blocks = strength.blocks;
    // Entry 0 of the counts is by definition empty: a stored pair has a nonzero feature.
    report.pairs_by_feature_count.assign(strength.pairs_by_features.begin() + 1,
                                         strength.pairs_by_features.end());
}

ReportPartition report_partition(const CutResult& cut, const Eigen::MatrixXd& part_areas) {
    ReportPartition report;
    report.eigenvalues = cut.eigenvalues;
    report.residuals = cut.residuals;
    report.starts = cut.starts;
    report.starts_left_out = cut.starts_left_out;
    report.chosen_start = cut.chosen;
    report.places = {cut.frame.directions.colwise().normalized(), cut.frame.correlation};
    report.part_area = to_vector(part_areas.rowwise().mean());
    if (!cut.part_counts.empty())
        report.part_count = {part_count_sentence(cut.part_counts), is_clear(cut.part_counts),
                             cut.part_counts};
    report.unions = cut.tree.unions;
    return report;
}

void add_run_facts(const Comm& comm, Report& report, const StageLog& log) {
    report.ranks = comm.size();
    report.seconds = log.seconds_since_start();
    const double mine = peak_memory_mib();
    MPI_Allreduce(&mine, &report.peak_memory_sum_mib, 1, MPI_DOUBLE, MPI_SUM, comm.raw());
    report.peak_memory_max_mib = all_max(comm, mine);
    report.stages = log.stages();
    report.warnings = log.warnings();
}

}  // namespace

void write_meshes(const Comm& comm, const std::string& folder, const Collection& collection,
                  const std::vector<MeshLabels>& labels) {
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            const std::string& name = collection.meshes[at(mesh.mesh)].name;
            write_labels(result_files::path_of(result_files::parts, folder, name), labels[k].part);
            write_labels(result_files::path_of(result_files::patches, folder, name), labels[k].patch);
            write_colored_ply(result_files::path_of(result_files::colored_meshes, folder, name), mesh.input,
                              labels[k].part, labels[k].confidence);
        }
    });
}

std::string run_report(const Comm& comm, const RunOutcome& outcome, const StageLog& log) {
    const Eigen::MatrixXd part_areas = gather_part_areas(comm, outcome);
    const FeatureStrength strength = feature_strength(comm, outcome.optimisation.result.coefficients,
                                                      outcome.cut.part_of_patch, outcome.parts);
    Report report;
    add_run_facts(comm, report, log);
    report.optimisation = {outcome.optimisation, outcome.collection.numbering.patch_count(),
                           outcome.optimisation.result};
    report.partition = report_partition(outcome.cut, part_areas);
    report.partition.affinity = affinity_picture(comm, outcome.optimisation.result.coefficients,
                                                 outcome.cut.part_of_patch, outcome.parts, affinity_bins);
    report.features.ranges = outcome.ranges;
    add_strengths(report.features, strength, outcome);
    report.state = outcome.state;
    report.meshes =
        report_meshes(outcome, part_areas, gather_confidence(comm, outcome), gather_checksums(comm, outcome));
    report.set_aside = outcome.collection.set_aside;
    std::vector<std::pair<std::string, std::string>> options;
    for (const OptionValue& option : outcome.options) options.emplace_back(option.key, option.value);
    return comm.is_root() ? report_text(library_versions(), options, report) : std::string();
}

void write_affinity_picture(const Comm& comm, const std::string& folder, const RunOutcome& outcome) {
    const SparseCoefficients& coefficients = outcome.optimisation.result.coefficients;
    if (all_sum(comm, static_cast<std::int64_t>(coefficients.rows.size())) == 0) return;
    const AffinityPicture picture =
        affinity_picture(comm, coefficients, outcome.cut.part_of_patch, outcome.parts, picture_bins);
    agree(comm, [&] {
        if (comm.is_root())
            write_png(folder + "/" + result_files::affinity, affinity_image(picture.rows, picture.part_ends));
    });
}

}  // namespace coseg
