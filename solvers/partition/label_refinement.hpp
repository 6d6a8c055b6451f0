#pragma once
// Labels of the pieces of a mesh made smooth: what each piece wants against the length of label boundaries.

#include <Eigen/Core>
#include <vector>

#include "solvers/oversegmentation/weighted_graph.hpp"
#include "src/mesh/dual_graph.hpp"

namespace coseg {

/// Contacts between pieces (e.g. src/mesh/connected_pieces.hpp: intersection_pieces): per pair of touching pieces
/// node_a < node_b the sum over their shared edges of length * dihedral_cost, ascending by pair.
std::vector<WeightedEdge> piece_contacts(const DualGraph& graph, const std::vector<int>& piece_of_face);

/// E(labels) = sum over pieces of cost(label, piece) + smoothness * sum over contacts between different
/// labels. cost: K x pieces, finite, lower is better.
double label_energy(const Eigen::MatrixXd& cost, const std::vector<WeightedEdge>& contacts, double smoothness,
                    const std::vector<int>& labels);

/// Lowers label_energy from `start` (one label in 0..K-1 per piece) by alpha-expansion, label after label
/// until none finds an improvement; for costs >= 0 the energy is then at most twice the least. Deterministic;
/// the energy never rises.
///
/// Then labels are guarded: one whose area falls below half its area in `start` gets its starting pieces back
/// (this may raise the energy; the reward is that no part withers away). piece_area: per piece, >= 0. Throws
/// Error(internal) for a cost that is not finite, a negative smoothness or contact, or a label out of range.
///
/// Source: Boykov, Veksler, Zabih 2001 (expansion); Kolmogorov and Zabih 2004 (its graph).
std::vector<int> refine_labels(const Eigen::MatrixXd& cost, const std::vector<WeightedEdge>& contacts,
                               double smoothness, const Eigen::VectorXd& piece_area,
                               const std::vector<int>& start);

}  // namespace coseg
