#pragma once
// Makes parts of coefficients: the affinity, cuts from several starts, and the choice among them.

#include <vector>

#include "solvers/partition/cut_input.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/cut_result.hpp"

namespace coseg {

/// (Adjacency, overlap) in {(0, 1), (.3, 1), (1, 1), (2, 2), (4, 4), (8, 8)}, clusters in {2K, 5K/2, 3K,
/// 7K/2, 4K}; the clusters are merged. With `placed`, links are weighed by position. Adjacency keeps parts in
/// one piece, but where shapes have many limbs it does harm in the cut.
std::vector<CutStart> pooled_starts(int parts, bool placed = false);

/// One cut into the parts, with adjacency = overlap. 0 with AffinityForm::formula_8 is the paper's text.
std::vector<CutStart> single_start(int parts, double adjacency);

/// A partition that was found in another way, numbered and described as partition_patches does, without
/// starts. labels: 0 .. parts-1 for each patch.
CutResult described_partition(const std::vector<int>& labels, int parts, const std::vector<int>& mesh_of,
                              const std::vector<double>& patch_area);

/// Fills in part_share and meshes_with_part for result.part_of_patch, 0 .. parts-1.
void describe_parts(const std::vector<int>& mesh_of, const std::vector<double>& patch_area, int parts,
                    CutResult& result);

/// Cuts the patches of all meshes into parts.
///
/// Up to one_rank_entries every node holds all of the affinity, the different graphs are shared out among
/// the ranks, and each graph is cut by one rank alone. Above that number every rank keeps its rows, and all
/// ranks solve each eigenvalue problem together. The result has the same bytes on any number of ranks, and
/// in both cases the same clusters.
///
/// With examples the parts are their labels, 0 .. parts-1, and patches whose label is known have it. Labels
/// without an example are given to parts that no example shows. Without examples parts are numbered by
/// decreasing mean share of the area.
///
/// Collective. Throws AgreedError: usage (parts out of range), input (nothing to cut), not_converged,
/// internal.
///
/// Source: the paper, equation (8), minima rule and normalised cut.
///
/// Deviates: `links`, adjacency, overlaps, the balance of meshes, positions, several starts and the choice
/// among them.
CutResult partition_patches(const Comm& comm, const CutInput& input, const CutOptions& options);

}  // namespace coseg
