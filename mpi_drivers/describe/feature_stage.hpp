#pragma once
// From descriptors of faces to features of patches: agreed ranges, shape words, histograms, gathered on every node.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "solvers/partition/partition_choice.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/histograms/feature_range.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/named_range.hpp"

namespace coseg {

/// What turns descriptors of faces into bins, so that shapes that come later fall into the same ones.
struct FeatureBins {
    std::vector<FeatureRange> ranges;  ///< of the scalar features of positive weight, in the order of Feature
    std::vector<Eigen::MatrixXf> words;  ///< per set: centres of the shape-context words, d x words
};

struct PatchFeatures {
    /// Features with positive weight: bins x N each (shape contexts: bins word_sets x N), times the weight; once a node.
    FeatureMatrices histograms;
    std::vector<int> feature_of;     ///< which Feature each of them is
    std::vector<double> patch_area;  ///< N, each mesh's over-segmentation sums to 1
    Eigen::Matrix3Xd positions;      ///< 3 x N, see patch_positions; 3 x 0 where what is cut are not patches
    /// What the choice of the partition looks at, where the histograms are gone before it; see choice_descriptors.
    std::vector<ChoiceDescriptor> choice;
    std::vector<NamedRange> ranges;  ///< the bin range of every scalar feature, for the report
    FeatureBins bins;
};

/// given: the bins of an earlier collection, which are kept; null: they are made from this one. Collective; the same bits on
/// every rank and on any number of ranks. Releases the descriptors of `collection`, which no later stage looks at.
PatchFeatures patch_features(const Comm& comm, Collection& collection, const RunOptions& options,
                             const FeatureBins* given = nullptr);

/// Says so where every rank has features of its own, for want of shared memory.
void warn_of_copies(const PatchFeatures& features, const StageLog& log);

}  // namespace coseg
