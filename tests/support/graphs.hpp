#pragma once
// Graphs with known spectra and cuts, and small collections with known parts.

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/histograms/single_precision_features.hpp"
#include "src/parallel/comm.hpp"

namespace coseg::testing_graphs {

struct Edge {
    int a = 0;
    int b = 0;
    double weight = 1.0;
};

/// All rows of the undirected graph.
SparseRows graph(int nodes, const std::vector<Edge>& edges);
/// The rows that this rank owns of a matrix that every rank holds.
SparseRows owned_rows(const Comm& comm, const SparseRows& complete);

std::vector<Edge> path_edges(int nodes);
std::vector<Edge> cycle_edges(int nodes);
std::vector<Edge> clique_edges(int first, int nodes, double weight = 1.0);
/// `blocks` groups of `nodes` each: random weights in [.5, 1.5] inside a group, `weak` times that between a
/// sixteenth of the other pairs.
std::vector<Edge> block_edges(int blocks, int nodes, double weak, std::uint64_t seed);

/// The same partition up to names.
bool same_partition(const std::vector<int>& a, const std::vector<int>& b);

/// Columns of this rank: about `per_column` random pairs in each, some columns empty, a third of the values
/// zero.
SparseCoefficients random_coefficients(const Comm& comm, int size, int features, int per_column,
                                       std::uint64_t seed);

/// Shapes of `parts` segments in a row, each segment of `patches_per_part` patches in a row, in two
/// over-segmentations that differ by nothing but numbers. Patches resemble those of the same segment in other
/// shapes, and some others by accident. Concavity is high where segments meet.
struct ToyCollection {
    int patches = 0;
    std::vector<int> mesh_of;
    std::vector<int> truth;
    std::vector<double> area;
    std::vector<GlobalPatchNeighbors> neighbors;
    std::vector<GlobalPatchOverlap> overlaps;
    SparseCoefficients coefficients;  ///< the columns of this rank
    Eigen::MatrixXf histograms;       ///< K x N: a descriptor that tells the segments apart, with some noise
};
/// Relations are those of the meshes m with m % ranks = rank.
ToyCollection toy_collection(const Comm& comm, int meshes, int parts, int patches_per_part,
                             std::uint64_t seed);
/// Its histograms as features of patches.
SinglePrecisionFeatures segment_features(const ToyCollection& toy);
/// Its histograms, where they lie, with what the descriptors of a run weigh together.
std::vector<ChoiceDescriptor> segment_descriptors(const ToyCollection& toy,
                                                  BetweenPartVariance weight = {.pooled = 1.0,
                                                                                .per_mesh = 4.8});
/// What is cut; it refers to the arguments.
CutInput toy_input(const ToyCollection& toy, std::span<const ChoiceDescriptor> descriptors,
                   const SinglePrecisionFeatures* features = nullptr);

}  // namespace coseg::testing_graphs
