#include "solvers/oversegmentation/fiedler_cut.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

constexpr int largest_dense = 48;  // up to here a dense solve is the faster one
constexpr int lanczos_basis = 8;   // vectors between restarts: the inverse has a gap, and few suffice
constexpr int lanczos_restarts = 200;
constexpr double lanczos_tolerance = 1e-7;  // relative to 1/mu; a sweep needs the order of the entries only

/// y -> M^1/2 P L^+ P M^1/2 y on the vectors orthogonal to M^1/2 1, whose largest eigenvalue is 1 / mu_2.
/// L is factored with its last row and column left out (that node's potential is 0), which a connected graph
/// makes positive definite; the projections P take out what that choice adds.
class InverseLaplacian {
  public:
    using Scalar = double;

    explicit InverseLaplacian(const WeightedGraph& graph);
    [[nodiscard]] bool is_factored() const { return factor_.info() == Eigen::Success; }
    [[nodiscard]] Eigen::Index rows() const { return root_mass_.size(); }
    [[nodiscard]] Eigen::Index cols() const { return root_mass_.size(); }
    void perform_op(const double* in, double* out) const;
    void project(Eigen::VectorXd& y) const { y -= constant_.dot(y) * constant_; }
    [[nodiscard]] const Eigen::VectorXd& root_mass() const { return root_mass_; }

  private:
    Eigen::VectorXd root_mass_;
    Eigen::VectorXd constant_;  // M^1/2 1 at unit length
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
};

/// The lower triangle of the Laplacian of the first `nodes` nodes: edges to others count for the diagonal
/// only.
Eigen::SparseMatrix<double> lower_laplacian(const WeightedGraph& graph, int nodes) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(graph.weights.size() / 2 + graph.mass.size());
    for (int v = 0; v < nodes; ++v) {
        double degree = 0.0;
        for (int k = graph.offsets[at(v)]; k < graph.offsets[at(v) + 1]; ++k) {
            const double weight = graph.weights[at(k)];
            const int u = graph.neighbors[at(k)];
            degree += weight;
            if (u < v) entries.emplace_back(v, u, -weight);
        }
        entries.emplace_back(v, v, degree);
    }
    Eigen::SparseMatrix<double> laplacian(nodes, nodes);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    return laplacian;
}

InverseLaplacian::InverseLaplacian(const WeightedGraph& graph) {
    const int grounded = graph.node_count() - 1;
    root_mass_ = Eigen::Map<const Eigen::VectorXd>(graph.mass.data(), graph.node_count()).cwiseSqrt();
    constant_ = root_mass_.normalized();
    factor_.compute(lower_laplacian(graph, grounded));
}

void InverseLaplacian::perform_op(const double* in, double* out) const {
    const Eigen::Index n = rows();
    Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(in, n);
    project(y);
    const Eigen::VectorXd right = root_mass_.cwiseProduct(y).head(n - 1);
    y.head(n - 1) = factor_.solve(right);
    y[n - 1] = 0.0;
    y = y.cwiseProduct(root_mass_);
    project(y);
    Eigen::Map<Eigen::VectorXd>(out, n) = y;
}

FiedlerPair finished_pair(double value, const Eigen::VectorXd& scaled, const Eigen::VectorXd& root_mass,
                          CutOrigin origin) {
    FiedlerPair pair{.value = value, .vector = {}, .origin = origin};
    const Eigen::VectorXd x = scaled.normalized().cwiseQuotient(root_mass);
    if (std::isfinite(value) && x.allFinite()) pair.vector.assign(x.begin(), x.end());
    return pair;
}

FiedlerPair lanczos_pair(const WeightedGraph& graph) {
    InverseLaplacian inverse(graph);
    if (!inverse.is_factored()) return {};
    Spectra::SymEigsSolver<InverseLaplacian> solver(inverse, 1, std::min(lanczos_basis, graph.node_count()));
    Eigen::VectorXd start(graph.node_count());
    for (int v = 0; v < graph.node_count(); ++v) {
        start[v] = uniform_of(mix_bits(static_cast<std::uint64_t>(v))) - 0.5;
    }
    inverse.project(start);
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestAlge, lanczos_restarts, lanczos_tolerance);
    if (solver.info() != Spectra::CompInfo::Successful || !(solver.eigenvalues()[0] > 0.0)) return {};
    return finished_pair(1.0 / solver.eigenvalues()[0], solver.eigenvectors().col(0), inverse.root_mass(),
                         CutOrigin::lanczos);
}

FiedlerPair dense_pair(const WeightedGraph& graph) {
    const int n = graph.node_count();
    const Eigen::VectorXd root_mass = Eigen::Map<const Eigen::VectorXd>(graph.mass.data(), n).cwiseSqrt();
    Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(n, n);
    for (int v = 0; v < n; ++v) {
        for (int k = graph.offsets[at(v)]; k < graph.offsets[at(v) + 1]; ++k) {
            const double weight = graph.weights[at(k)];
            const int u = graph.neighbors[at(k)];
            scaled(v, v) += weight / graph.mass[at(v)];
            scaled(v, u) = -weight / (root_mass[v] * root_mass[u]);
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
    if (solver.info() != Eigen::Success) return {};
    return finished_pair(solver.eigenvalues()[1], solver.eigenvectors().col(1), root_mass, CutOrigin::dense);
}

/// Number of edges from `start`; the graph is connected.
std::vector<double> distances_from(const WeightedGraph& graph, int start) {
    std::vector<double> distance(graph.mass.size(), -1.0);
    std::vector<int> queue{start};
    distance[at(start)] = 0.0;
    for (std::size_t head = 0; head < queue.size(); ++head) {
        const auto v = at(queue[head]);
        for (int k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
            const auto u = at(graph.neighbors[at(k)]);
            if (distance[u] >= 0.0) continue;
            distance[u] = distance[v] + 1.0;
            queue.push_back(static_cast<int>(u));
        }
    }
    return distance;
}

std::vector<double> distances_from_far_node(const WeightedGraph& graph) {
    const std::vector<double> from_first = distances_from(graph, 0);
    const auto far = std::max_element(from_first.begin(), from_first.end()) - from_first.begin();
    return distances_from(graph, static_cast<int>(far));
}

/// The best prefix of the nodes sorted by `key` (ties: lower node first).
TwoWayCut sweep_cut(const WeightedGraph& graph, const std::vector<double>& key) {
    std::vector<int> order(key.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[at(a)] < key[at(b)]; });
    const double total = std::accumulate(graph.mass.begin(), graph.mass.end(), 0.0);
    TwoWayCut best{.side = std::vector<char>(key.size(), 1),
                   .value = std::numeric_limits<double>::infinity()};
    std::vector<char> is_in(key.size(), 0);
    double cut = 0.0;
    double mass = 0.0;
    std::size_t best_size = 1;
    for (std::size_t size = 1; size < order.size(); ++size) {
        const auto v = at(order[size - 1]);
        for (int k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
            const auto slot = at(k);
            cut += is_in[at(graph.neighbors[slot])] != 0 ? -graph.weights[slot] : graph.weights[slot];
        }
        is_in[v] = 1;
        mass += graph.mass[v];
        const double value = cut / mass + cut / (total - mass);
        if (value < best.value) {
            best.value = value;
            best_size = size;
        }
    }
    for (std::size_t k = 0; k < best_size; ++k) best.side[at(order[k])] = 0;
    return best;
}

TwoWayCut component_cut(const std::vector<int>& component) {
    TwoWayCut cut;
    cut.side.resize(component.size());
    std::transform(component.begin(), component.end(), cut.side.begin(),
                   [](int c) { return c == 0 ? 0 : 1; });
    return cut;
}

}  // namespace

std::vector<int> elimination_places(const WeightedGraph& graph) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    const Eigen::SparseMatrix<double> laplacian = lower_laplacian(graph, graph.node_count());
    Eigen::AMDOrdering<int>()(laplacian.selfadjointView<Eigen::Lower>(), order);
    const Eigen::VectorXi places = order.inverse().eval().indices();
    return {places.begin(), places.end()};
}

FiedlerPair fiedler_pair(const WeightedGraph& graph) {
    FiedlerPair pair;
    if (graph.node_count() > largest_dense) pair = lanczos_pair(graph);
    if (pair.vector.empty()) pair = dense_pair(graph);
    return pair;
}

TwoWayCut fiedler_cut(const WeightedGraph& graph) {
    const std::vector<int> component = connected_components(graph);
    if (std::any_of(component.begin(), component.end(), [](int c) { return c > 0; }))
        return component_cut(component);
    const FiedlerPair pair = fiedler_pair(graph);
    const bool has_vector = !pair.vector.empty();
    TwoWayCut cut = sweep_cut(graph, has_vector ? pair.vector : distances_from_far_node(graph));
    cut.origin = has_vector ? pair.origin : CutOrigin::breadth_first;
    cut.fiedler_value = has_vector ? pair.value : 0.0;
    if (cut.side[0] != 0) {
        for (char& side : cut.side) side = static_cast<char>(1 - side);
    }
    return cut;
}

}  // namespace coseg
