#pragma once
// Makes features of patches from descriptors of faces: ranges on which all ranks agree, shape words, and
// histograms, which are gathered on every node.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "src/descriptors/descriptor_table.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/histograms/feature_range.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/named_range.hpp"

namespace coseg {

/// The rule that turns the values of faces into bins, so that shapes that come later fall into the same ones.
/// For numbers it is a range; for vectors it is the centres of the words, d x words for every set.
using FeatureBins = std::variant<FeatureRange, std::vector<Eigen::MatrixXf>>;

struct PatchFeatures {
    /// Features with positive weight: bins x N each (words: bins word_sets x N), times the weight; once a
    /// node.
    FeatureMatrices histograms;
    HistogramScaling scaling = HistogramScaling::square_root;
    std::vector<Descriptor> descriptors;  ///< what each of them describes, with the weight of the run
    std::vector<FeatureBins> bins;        ///< of each of them
    std::vector<double> patch_area;       ///< N, each mesh's over-segmentation sums to 1
    Eigen::Matrix3Xd positions;      ///< 3 x N, see patch_positions; 3 x 0 where what is cut are not patches
    std::vector<NamedRange> ranges;  ///< the bin range of every feature of numbers, for the report
};

/// Each of `descriptors` is freed as soon as its feature is made; rows without a weight are left out. `given`
/// holds the bins of an earlier collection, one for each feature, which are kept; with null they are made
/// from this one. The log has the stage "features", and a warning where every rank holds features of its own
/// because shared memory is too small. Collective; the result has the same bits on every rank and on any
/// number of ranks.
PatchFeatures patch_features(const Comm& comm, const Collection& collection,
                             CollectionDescriptors descriptors, const FeatureOptions& options,
                             const std::vector<FeatureBins>* given, StageLog& log);

}  // namespace coseg
