#include "solvers/partition/label_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "solvers/boundaries/minimum_cut.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/dihedral_cost.hpp"

namespace coseg {

namespace {

constexpr double smallest_share_kept = 0.5;     // of a label's area at the start
constexpr double smallest_improvement = 1e-12;  // relative: below it, rounding could make expansions cycle

void check_problem(const Eigen::MatrixXd& cost, const std::vector<WeightedEdge>& contacts, double smoothness,
                   const Eigen::VectorXd& piece_area, const std::vector<int>& start) {
    const bool labels_fit =
        std::all_of(start.begin(), start.end(), [&](int l) { return l >= 0 && l < cost.rows(); });
    const bool contacts_fit = std::all_of(contacts.begin(), contacts.end(), [&](const WeightedEdge& c) {
        return c.weight >= 0.0 && std::isfinite(c.weight) && c.node_a >= 0 && c.node_b >= 0 &&
               c.node_a < cost.cols() && c.node_b < cost.cols();
    });
    const bool sizes_fit =
        static_cast<Eigen::Index>(start.size()) == cost.cols() && piece_area.size() == cost.cols();
    if (!sizes_fit || !labels_fit || !contacts_fit || !cost.allFinite() || !(smoothness >= 0.0)) {
        throw Error(ExitCode::internal,
                    "label refinement was given costs, contacts or labels that do not fit together");
    }
}

/// The labelling of least energy in which every piece keeps its label or takes `alpha`.
std::vector<int> expansion(const Eigen::MatrixXd& cost, const std::vector<WeightedEdge>& contacts,
                           double smoothness, const std::vector<int>& labels, int alpha) {
    std::vector<double> price(labels.size());  // of taking alpha (sink side) over keeping (source side)
    for (std::size_t p = 0; p < labels.size(); ++p) {
        const auto piece = static_cast<Eigen::Index>(p);
        price[p] = cost(alpha, piece) - cost(labels[p], piece);
    }
    std::vector<CutArc> arcs;
    for (const WeightedEdge& c : contacts) {
        const auto a = static_cast<std::size_t>(c.node_a);
        const auto b = static_cast<std::size_t>(c.node_b);
        const double weight = smoothness * c.weight;
        const double both_keep = labels[a] != labels[b] ? weight : 0.0;
        const double only_b_takes = labels[a] != alpha ? weight : 0.0;
        const double only_a_takes = labels[b] != alpha ? weight : 0.0;
        price[a] += only_a_takes - both_keep;
        price[b] -= only_a_takes;
        arcs.push_back({c.node_a, c.node_b, only_b_takes + only_a_takes - both_keep, 0.0});
    }
    std::vector<double> keep(labels.size(), 0.0), take(labels.size(), 0.0);
    for (std::size_t p = 0; p < labels.size(); ++p) (price[p] > 0.0 ? keep[p] : take[p]) = std::abs(price[p]);
    const std::vector<char> side = minimum_cut(keep, take, arcs);
    std::vector<int> expanded = labels;
    for (std::size_t p = 0; p < labels.size(); ++p) {
        if (side[p] != 0) expanded[p] = alpha;
    }
    return expanded;
}

Eigen::VectorXd label_areas(const Eigen::VectorXd& piece_area, const std::vector<int>& labels,
                            Eigen::Index count) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(count);
    for (std::size_t p = 0; p < labels.size(); ++p)
        area[labels[p]] += piece_area[static_cast<Eigen::Index>(p)];
    return area;
}

/// Gives their pieces back to labels that lost too much. A label given back keeps its pieces, so this ends
/// after at most one round a label.
void restore_withered_labels(const Eigen::VectorXd& piece_area, const std::vector<int>& start,
                             std::vector<int>& labels, Eigen::Index count) {
    const Eigen::VectorXd before = label_areas(piece_area, start, count);
    for (Eigen::Index round = 0; round < count; ++round) {
        const Eigen::VectorXd now = label_areas(piece_area, labels, count);
        for (std::size_t p = 0; p < labels.size(); ++p) {
            if (now[start[p]] < smallest_share_kept * before[start[p]]) labels[p] = start[p];
        }
    }
}

}  // namespace

std::vector<WeightedEdge> piece_contacts(const DualGraph& graph, const std::vector<int>& piece_of_face) {
    std::vector<WeightedEdge> contacts;
    for (const DualEdge& e : graph.edges) {
        const int a = piece_of_face[at(e.face_a)];
        const int b = piece_of_face[at(e.face_b)];
        if (a != b) contacts.push_back({std::min(a, b), std::max(a, b), e.length * dihedral_cost(e)});
    }
    std::stable_sort(contacts.begin(), contacts.end(), [](const WeightedEdge& x, const WeightedEdge& y) {
        return std::tie(x.node_a, x.node_b) < std::tie(y.node_a, y.node_b);
    });
    std::vector<WeightedEdge> sums;
    for (const WeightedEdge& c : contacts) {
        if (!sums.empty() && sums.back().node_a == c.node_a && sums.back().node_b == c.node_b) {
            sums.back().weight += c.weight;
        } else {
            sums.push_back(c);
        }
    }
    return sums;
}

double label_energy(const Eigen::MatrixXd& cost, const std::vector<WeightedEdge>& contacts, double smoothness,
                    const std::vector<int>& labels) {
    double energy = 0.0;
    for (std::size_t p = 0; p < labels.size(); ++p) energy += cost(labels[p], static_cast<Eigen::Index>(p));
    for (const WeightedEdge& c : contacts) {
        const bool is_cut = labels[at(c.node_a)] != labels[at(c.node_b)];
        if (is_cut) energy += smoothness * c.weight;
    }
    return energy;
}

std::vector<int> refine_labels(const Eigen::MatrixXd& cost, const std::vector<WeightedEdge>& contacts,
                               double smoothness, const Eigen::VectorXd& piece_area,
                               const std::vector<int>& start) {
    check_problem(cost, contacts, smoothness, piece_area, start);
    std::vector<int> labels = start;
    double energy = label_energy(cost, contacts, smoothness, labels);
    const double tolerance = smallest_improvement * (cost.cwiseAbs().sum() + std::abs(energy));
    for (bool improves = true; improves;) {
        improves = false;
        for (int alpha = 0; alpha < static_cast<int>(cost.rows()); ++alpha) {
            std::vector<int> candidate = expansion(cost, contacts, smoothness, labels, alpha);
            const double lower = label_energy(cost, contacts, smoothness, candidate);
            if (!(lower < energy - tolerance)) continue;
            labels = std::move(candidate);
            energy = lower;
            improves = true;
        }
    }
    restore_withered_labels(piece_area, start, labels, cost.rows());
    return labels;
}

}  // namespace coseg
