#pragma once
// DIR/report.json: what was run, with what, how long it took and what came out. Format: docs/formats.md.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "src/records/affinity_picture.hpp"
#include "src/records/fields.hpp"
#include "src/records/mesh_facts.hpp"
#include "src/records/named_range.hpp"
#include "src/records/optimisation_facts.hpp"
#include "src/records/part_count.hpp"
#include "src/records/part_tree.hpp"
#include "src/records/solve_summary.hpp"
#include "src/records/stage_times.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

struct ReportMesh {
    MeshFacts facts;
    int patches = 0;                ///< over all over-segmentations
    std::vector<double> part_area;  ///< share of the mesh's area, per part
    /// The mean over the area of the probability that a face has the right part; none where it is not known.
    std::optional<double> confidence;
    /// Checksums of the label files, as `xxhsum -H2` prints them.
    std::string labels_xxh3;
    std::string patches_xxh3;
    /// In hexadecimal digits, where they are not UTF-8 and therefore no text of JSON.
    std::optional<std::string> name_bytes;
    std::optional<std::string> path_bytes;
    static constexpr auto fields() {
        return std::tuple(
            inlined(&ReportMesh::facts), field("patches", &ReportMesh::patches),
            field("part_area", &ReportMesh::part_area), field("confidence", &ReportMesh::confidence),
            field("labels_xxh3", &ReportMesh::labels_xxh3), field("patches_xxh3", &ReportMesh::patches_xxh3),
            field("name_bytes", &ReportMesh::name_bytes), field("path_bytes", &ReportMesh::path_bytes));
    }
};

struct ReportOptimisation {
    OptimisationFacts facts;
    std::int64_t patches = 0;
    SolveSummary solution;
    static constexpr auto fields() {
        return std::tuple(inlined(&ReportOptimisation::facts), field("patches", &ReportOptimisation::patches),
                          inlined(&ReportOptimisation::solution));
    }
};

/// Three unit vectors in the axes of the files, ascending by how well the positions of linked patches agree
/// along them.
struct ReportPlaces {
    Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();  ///< one a column
    Eigen::Vector3d correlations = Eigen::Vector3d::Zero();
    static constexpr auto fields() {
        return std::tuple(field("directions", &ReportPlaces::directions),
                          field("correlations", &ReportPlaces::correlations));
    }
};

/// How the number of parts was found.
struct ReportPartCount {
    std::string sentence;                   ///< what was taken, what came next, and why
    bool clear = false;                     ///< whether one number is better than all others
    std::vector<PartCountFigures> numbers;  ///< by falling merit
    static constexpr auto fields() {
        return std::tuple(field("sentence", &ReportPartCount::sentence),
                          field("clear", &ReportPartCount::clear),
                          field("numbers", &ReportPartCount::numbers));
    }
};

struct ReportPartition {
    std::vector<double> eigenvalues;  ///< of the chosen start's graph
    std::vector<double> residuals;    ///< norms of the residuals of their eigenvectors
    std::vector<StartOutcome> starts;
    int starts_left_out = 0;  ///< after a look at a sample of the shapes
    int chosen_start = 0;
    ReportPlaces places;
    std::vector<double> part_area;              ///< mean over shapes of each part's share of the area
    std::optional<ReportPartCount> part_count;  ///< of --parts auto
    std::vector<PieceUnion> unions;  ///< of the tree of parts, from the finest level; none without one
    AffinityPicture affinity;
    static constexpr auto fields() {
        return std::tuple(
            field("eigenvalues", &ReportPartition::eigenvalues),
            field("residuals", &ReportPartition::residuals), field("starts", &ReportPartition::starts),
            field("starts_left_out", &ReportPartition::starts_left_out),
            field("chosen_start", &ReportPartition::chosen_start), field("places", &ReportPartition::places),
            field("part_area", &ReportPartition::part_area),
            field("part_count", &ReportPartition::part_count), field("unions", &ReportPartition::unions),
            field("affinity", &ReportPartition::affinity));
    }
};

struct ReportStrength {
    std::string feature;
    double overall = 0.0;             ///< share of the coefficients' sum
    std::vector<double> within_part;  ///< the same inside each part
    static constexpr auto fields() {
        return std::tuple(field("feature", &ReportStrength::feature),
                          field("overall", &ReportStrength::overall),
                          field("within_part", &ReportStrength::within_part));
    }
};

struct ReportFeatures {
    std::vector<NamedRange> ranges;
    std::vector<ReportStrength> strengths;
    std::vector<std::int64_t> pairs_by_feature_count;  ///< pairs with 1, 2, ... nonzero features
    std::vector<double> inside_part;  ///< per part: share of its columns that stays inside it
    std::vector<std::vector<double>> coefficient_blocks;  ///< parts x parts: share of all, row x column
    static constexpr auto fields() {
        return std::tuple(field("ranges", &ReportFeatures::ranges),
                          field("strengths", &ReportFeatures::strengths),
                          field("pairs_by_feature_count", &ReportFeatures::pairs_by_feature_count),
                          field("inside_part", &ReportFeatures::inside_part),
                          field("coefficient_blocks", &ReportFeatures::coefficient_blocks));
    }
};

/// With --state: what was there already and what had to be computed.
struct ReportState {
    std::string folder;
    std::int64_t meshes_reused = 0;
    std::int64_t meshes_described = 0;
    std::int64_t tiles_reused = 0;  ///< of the optimiser
    std::int64_t tiles_solved = 0;
    std::int64_t cuts_reused = 0;
    static constexpr auto fields() {
        return std::tuple(field("folder", &ReportState::folder),
                          field("meshes_reused", &ReportState::meshes_reused),
                          field("meshes_described", &ReportState::meshes_described),
                          field("tiles_reused", &ReportState::tiles_reused),
                          field("tiles_solved", &ReportState::tiles_solved),
                          field("cuts_reused", &ReportState::cuts_reused));
    }
};

struct Report {
    int ranks = 0;
    double seconds = 0.0;
    double peak_memory_sum_mib = 0.0;  ///< sum over ranks of each rank's peak resident memory
    double peak_memory_max_mib = 0.0;
    std::vector<StageTimes> stages;
    ReportOptimisation optimisation;
    ReportPartition partition;
    ReportFeatures features;
    std::optional<ReportState> state;
    std::vector<ReportMesh> meshes;
    std::vector<SetAside> set_aside;
    std::vector<std::string> warnings;  ///< about the whole run; those about shapes stand with them
    static constexpr auto fields() {
        return std::tuple(field("ranks", &Report::ranks), field("seconds", &Report::seconds),
                          field("peak_memory_sum_mib", &Report::peak_memory_sum_mib),
                          field("peak_memory_max_mib", &Report::peak_memory_max_mib),
                          field("stages", &Report::stages), field("optimisation", &Report::optimisation),
                          field("partition", &Report::partition), field("features", &Report::features),
                          field("state", &Report::state), field("meshes", &Report::meshes),
                          field("set_aside", &Report::set_aside), field("warnings", &Report::warnings));
    }
};

/// Names and what belongs to them, as texts.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// The text of report.json, with its checksum (io/files/text_checksum.hpp). options: every option as
/// resolved; those that are numbers or truth values are written so.
std::string report_text(const NamedTexts& versions, const NamedTexts& options, const Report& report);

}  // namespace coseg
