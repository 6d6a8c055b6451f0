#include "mpi_drivers/results/output_stage.hpp"

#include <sys/resource.h>

#include "io/data_files/label_file.hpp"
#include "io/mesh_files/ply_format.hpp"
#include "io/reports/affinity_image.hpp"
#include "io/reports/png_writer.hpp"
#include "io/reports/report.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/process/version.hpp"
#include "solvers/affinity/affinity_picture.hpp"
#include "solvers/subspace/feature_strength.hpp"
#include "src/base/index.hpp"

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
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(outcome.options.parts, meshes);
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

std::vector<ReportMesh> report_meshes(const RunOutcome& outcome, const Eigen::MatrixXd& part_areas) {
    std::vector<ReportMesh> rows;
    for (std::size_t m = 0; m < outcome.collection.meshes.size(); ++m) {
        const MeshFacts& mesh = outcome.collection.meshes[m];
        rows.push_back({.name = mesh.name,
                        .path = mesh.path,
                        .faces = mesh.input_faces,
                        .working_faces = mesh.working_faces,
                        .remeshed = mesh.remeshed,
                        .overlong_area = mesh.overlong_area,
                        .patches = outcome.collection.numbering.count(static_cast<int>(m)),
                        .rank = mesh.owner,
                        .seconds = mesh.seconds,
                        .part_area = to_vector(part_areas.col(static_cast<Eigen::Index>(m))),
                        .warnings = mesh.warnings});
    }
    return rows;
}

ReportOptimisation report_optimisation(const RunOutcome& outcome) {
    const SolveResult& solution = outcome.optimisation.result;
    return {.variant = outcome.optimisation.variant,
            .scope = outcome.optimisation.scope,
            .links = outcome.optimisation.links,
            .subsets = outcome.optimisation.subsets,
            .common_meshes = outcome.optimisation.common_meshes,
            .subset_agreement = outcome.optimisation.subset_agreement,
            .allowed_pairs = outcome.optimisation.allowed_pairs,
            .patches = outcome.collection.numbering.patch_count(),
            .objective = solution.objective,
            .objective_at_zero = solution.objective_at_zero,
            .lower_bound = solution.lower_bound,
            .relative_gap = solution.relative_gap,
            .kkt_residual = solution.kkt_residual,
            .iterations = solution.iterations,
            .nonzero_groups = solution.nonzero_groups,
            .reason = to_string(solution.reason),
            .history = report_passes(solution.history)};
}

void add_strengths(Report& report, const FeatureStrength& strength, const RunOutcome& outcome) {
    for (std::size_t h = 0; h < strength.overall.size(); ++h) {
        ReportStrength row{
            .feature = outcome.optimisation.features[h], .overall = strength.overall[h], .within_part = {}};
        for (const std::vector<double>& part : strength.of_part) row.within_part.push_back(part[h]);
        report.feature_strengths.push_back(std::move(row));
    }
    report.inside_part = strength.inside;
    report.coefficient_blocks = strength.blocks;
    // Entry 0 of the counts is by definition empty: a stored pair has a nonzero feature.
    report.pairs_by_feature_count.assign(strength.pairs_by_features.begin() + 1,
                                         strength.pairs_by_features.end());
}

void add_partition(Report& report, const CutResult& cut) {
    for (const StartOutcome& start : cut.starts) {
        ReportStart row{.adjacency = start.start.graph.adjacency,
                        .placed = start.start.graph.placed,
                        .clusters = start.start.clusters,
                        .merging = start.start.merging == MergeRule::linkage ? "linkage" : "normalized_cut",
                        .score = start.score,
                        .concavity = start.terms.concavity,
                        .presence = start.terms.presence,
                        .link_consistency = start.terms.link_consistency,
                        .explained_common = {},
                        .explained_own = {}};
        for (const auto& [pooled, per_mesh] : start.terms.explained) {
            row.explained_common.push_back(pooled);
            row.explained_own.push_back(per_mesh);
        }
        report.starts.push_back(std::move(row));
    }
    report.chosen_start = cut.chosen;
    for (int a = 0; a < 3; ++a) {
        const Eigen::Vector3d direction = cut.frame.directions.col(a).normalized();
        report.position_directions.push_back({direction[0], direction[1], direction[2]});
        report.position_correlations.push_back(cut.frame.correlation[a]);
    }
    if (cut.starts.empty()) return;  // one part needs no cut
    report.eigenvalues = cut.starts[at(cut.chosen)].eigenvalues;
}

void add_run_facts(const Comm& comm, Report& report, const StageLog& log) {
    report.ranks = comm.size();
    report.seconds = log.seconds_since_start();
    const double mine = peak_memory_mib();
    MPI_Allreduce(&mine, &report.peak_memory_sum_mib, 1, MPI_DOUBLE, MPI_SUM, comm.raw());
    report.peak_memory_max_mib = all_max(comm, mine);
    for (const StageTimes& s : log.stages()) {
        report.stages.push_back({s.stage, s.seconds_min, s.seconds_mean, s.seconds_max, s.seconds_wall, {}});
        for (const StepTime& step : s.steps) report.stages.back().steps.push_back({step.step, step.seconds});
    }
}

/// W permuted by part, finer than in the report. An assignment has no coefficients of its own to draw. Collective.
void write_affinity_picture(const Comm& comm, const ResultFolder& folder, const RunOutcome& outcome) {
    const SparseCoefficients& coefficients = outcome.optimisation.result.coefficients;
    if (all_sum(comm, static_cast<std::int64_t>(coefficients.rows.size())) == 0) return;
    const AffinityPicture picture =
        affinity_picture(comm, coefficients, outcome.cut.part_of_patch, outcome.options.parts, picture_bins);
    agree(comm, [&] {
        if (comm.is_root())
            write_png(folder.staging() + "/affinity.png", affinity_image(picture.rows, picture.part_ends));
    });
}

}  // namespace

ResultFolder::ResultFolder(const Comm& comm, const std::string& path, bool force) {
    agree(comm, [&] {
        if (!comm.is_root()) return;
        const TerminationPause pause;
        on_root_.emplace(path, force);
        watch_.emplace([this] { on_root_->abandon(); });
    });
    std::vector<std::string> staging;
    if (comm.is_root()) staging = {on_root_->staging()};
    broadcast_texts(comm, staging);
    staging_ = staging.front();
}

void ResultFolder::commit(const Comm& comm) {
    agree(comm, [&] {
        if (comm.is_root()) on_root_->commit();
    });
}

void write_meshes(const Comm& comm, const ResultFolder& folder, const Collection& collection,
                  const std::vector<MeshLabels>& labels) {
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            const std::string& name = collection.meshes[at(mesh.mesh)].name;
            write_labels(folder.staging() + "/labels/" + name + ".seg", labels[k].part);
            write_labels(folder.staging() + "/patches/" + name + ".seg", labels[k].patch);
            write_colored_ply(folder.staging() + "/ply/" + name + ".ply", mesh.input, labels[k].part);
        }
    });
}

void write_run_report(const Comm& comm, const ResultFolder& folder, const RunOutcome& outcome,
                      const StageLog& log) {
    const Eigen::MatrixXd part_areas = gather_part_areas(comm, outcome);
    const FeatureStrength strength = feature_strength(comm, outcome.optimisation.result.coefficients,
                                                      outcome.cut.part_of_patch, outcome.options.parts);
    Report report;
    report.options = outcome.resolved;
    report.versions = library_versions();
    add_run_facts(comm, report, log);
    report.state = outcome.state;
    report.meshes = report_meshes(outcome, part_areas);
    for (const SetAside& mesh : outcome.collection.set_aside)
        report.set_aside.emplace_back(mesh.path, mesh.reason);
    for (const NamedRange& r : outcome.features.ranges)
        report.ranges.push_back({r.feature, r.kind, r.low, r.high});
    report.optimisation = report_optimisation(outcome);
    add_partition(report, outcome.cut);
    AffinityPicture affinity =
        affinity_picture(comm, outcome.optimisation.result.coefficients, outcome.cut.part_of_patch,
                         outcome.options.parts, affinity_bins);
    report.affinity_rows = std::move(affinity.rows);
    report.affinity_part_ends = std::move(affinity.part_ends);
    report.part_area = to_vector(part_areas.rowwise().mean());
    add_strengths(report, strength, outcome);
    if (outcome.options.sheet) write_affinity_picture(comm, folder, outcome);
    agree(comm, [&] {
        if (comm.is_root()) write_report(folder.staging() + "/report.json", report);
    });
}

}  // namespace coseg
