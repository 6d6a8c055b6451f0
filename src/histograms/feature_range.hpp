#pragma once
// Finds the bin range of each feature, which all patches of all meshes share.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {

enum class RangeKind {
    per_mesh_percentile,  ///< values rescaled per mesh first (rescale_per_mesh); equal bins over [0, 1]
    global_percentile,    ///< equal bins between the collection's 1st and 99th percentile
    equal_mass,           ///< each bin holds the same share of the collection's weight (rank bins)
};

/// Bin b holds edges[b] < value <= edges[b + 1]. The first bin also holds everything below, the last one
/// everything above.
struct FeatureRange {
    RangeKind kind = RangeKind::per_mesh_percentile;
    /// Bins + 1, ascending; repeated where many values are equal (that bin stays empty).
    std::vector<double> edges;
    [[nodiscard]] int bins() const noexcept { return static_cast<int>(edges.size()) - 1; }
};

/// One feature of one mesh of this rank.
struct FeatureOfMesh {
    std::uint64_t mesh_key = 0;               ///< hash_text(name)
    const Eigen::VectorXd* values = nullptr;  ///< F
    /// F, >= 0: the same weights as in the histograms (face area or ones).
    const Eigen::VectorXd* weights = nullptr;
};

/// The number of faces from which a range is made: all of them in collections up to this size, a hashed
/// sample of about this size in larger ones. Their values are gathered to every rank (16 bytes a face).
inline constexpr std::int64_t range_sample_faces = 1 << 18;

/// The range of one feature over the whole collection. It has the same bits on every rank and on any number
/// of ranks. Throws AgreedError(input) if a value is not finite or the collection has no face,
/// AgreedError(internal) if bins < 1 or sizes differ. Collective.
///
/// Deviates: the bins of Gaussian curvature have equal mass, because otherwise every flat patch would fall
/// into one bin; the paper has one plain range for each feature.
FeatureRange agree_on_range(const Comm& comm, RangeKind kind, int bins, std::span<const FeatureOfMesh> local,
                            std::uint64_t seed);

/// Maps the area-weighted 1st and 99th percentile of one mesh to 0 and 1, linearly, and clamps what lies
/// outside. All values become 0 if the two percentiles are equal up to rounding (1e-9 relative, 1e-12
/// absolute).
void rescale_per_mesh(Eigen::VectorXd& values, const Eigen::VectorXd& area);

/// For each of the ascending `fractions` in [0, 1] the smallest value up to which that fraction of the weight
/// lies. Without any weight all values count equally. values must not be empty.
std::vector<double> weighted_quantiles(std::span<const double> values, std::span<const double> weights,
                                       std::span<const double> fractions);

}  // namespace coseg
