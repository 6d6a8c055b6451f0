#pragma once
// DIR/report.json: what was run, with what, how long it took and what came out. Format: docs/formats.md.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace coseg {

struct ReportStep {
    std::string step;
    double seconds = 0.0;  ///< sum over ranks
};

struct ReportStage {
    std::string stage;
    double seconds_min = 0.0;  ///< over ranks, a rank's own work
    double seconds_mean = 0.0;
    double seconds_max = 0.0;
    double seconds_wall = 0.0;
    std::vector<ReportStep> steps;  ///< empty where the stage does not tell
};

struct ReportMesh {
    std::string name;
    std::string path;
    int faces = 0;          ///< in the file
    int working_faces = 0;  ///< after repair, remeshing and refinement
    bool remeshed = false;
    double overlong_area = 0.0;  ///< share of the area in triangles too long for patches
    int patches = 0;             ///< over all over-segmentations
    int rank = 0;
    double seconds = 0.0;
    std::vector<double> part_area;  ///< share of the mesh's area, per part
    std::vector<std::string> warnings;
};

struct ReportRange {
    std::string feature;
    std::string kind;
    double low = 0.0;
    double high = 0.0;
};

/// The optimiser after a pass over all pairs.
struct ReportPass {
    int pass = 0;  ///< from 1
    int iterations = 0;
    double objective = 0.0;
    double lower_bound = 0.0;
    double relative_gap = 0.0;
    std::int64_t working_pairs = 0;
};

struct ReportOptimisation {
    std::string variant;
    std::string scope;
    int links = 0;  ///< meshes in which a patch may have matches, at most
    int subsets = 1;
    int common_meshes = 0;
    double subset_agreement = 1.0;
    std::int64_t allowed_pairs = 0;
    std::int64_t patches = 0;
    double objective = 0.0;
    double objective_at_zero = 0.0;
    double lower_bound = 0.0;
    double relative_gap = 0.0;
    double kkt_residual = 0.0;
    int iterations = 0;
    std::int64_t nonzero_groups = 0;
    std::string reason;
    std::vector<ReportPass> history;
};

struct ReportStart {
    double adjacency = 0.0;
    bool placed = false;  ///< links weighed by place
    int clusters = 0;
    std::string merging;  ///< the rule that merged the clusters
    double score = 0.0;
    double concavity = 0.0;
    double presence = 0.0;
    double link_consistency = 0.0;
    std::vector<double> explained_common;  ///< per descriptor that the choice looks at
    std::vector<double> explained_own;
};

struct ReportStrength {
    std::string feature;
    double overall = 0.0;             ///< share of the coefficients' sum
    std::vector<double> within_part;  ///< the same inside each part
};

/// With --state: what was there already and what had to be computed.
struct ReportState {
    std::string folder;  ///< empty without --state
    std::int64_t meshes_reused = 0;
    std::int64_t meshes_described = 0;
    std::int64_t tiles_reused = 0;  ///< of the optimiser
    std::int64_t tiles_solved = 0;
    std::int64_t cuts_reused = 0;
};

struct Report {
    std::vector<std::pair<std::string, std::string>> options;
    std::vector<std::pair<std::string, std::string>> versions;
    int ranks = 0;
    double seconds = 0.0;
    double peak_memory_sum_mib = 0.0;  ///< sum over ranks of each rank's peak resident memory
    double peak_memory_max_mib = 0.0;
    ReportState state;
    std::vector<ReportStage> stages;
    std::vector<ReportMesh> meshes;
    std::vector<std::pair<std::string, std::string>> set_aside;  ///< path and reason
    std::vector<ReportRange> ranges;
    ReportOptimisation optimisation;
    std::vector<std::string> affinity_rows;  ///< the affinity as a picture: docs/formats.md
    std::vector<int> affinity_part_ends;
    std::vector<double> eigenvalues;
    std::vector<ReportStart> starts;
    int chosen_start = 0;
    /// Three unit vectors in the axes of the files, ascending by how well the positions of linked patches
    /// agree along them.
    std::vector<std::vector<double>> position_directions;
    std::vector<double> position_correlations;
    std::vector<double> part_area;  ///< mean over shapes of each part's share of the area
    std::vector<ReportStrength> feature_strengths;
    /// Per part: share of the coefficients of its columns that stay inside it.
    std::vector<double> inside_part;
    /// Parts x parts: share of all coefficients, row x column.
    std::vector<std::vector<double>> coefficient_blocks;
    std::vector<std::int64_t> pairs_by_feature_count;  ///< pairs with 1, 2, ... nonzero features
};

/// The history as the report has it: the text of a JSON array.
std::string history_json(const std::vector<ReportPass>& history);

/// Throws Error(output) if the file cannot be written.
void write_report(const std::string& path, const Report& report);

}  // namespace coseg
