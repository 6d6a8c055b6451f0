#include "solvers/choice/patch_moves.hpp"

#include <Eigen/Core>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The sums over a part, in one mesh or in all.
struct PartSums {
    Eigen::MatrixXf deviations;  ///< D x K
    Eigen::VectorXd area;        ///< K

    PartSums() = default;
    PartSums(Eigen::Index rows, int parts)
        : deviations(Eigen::MatrixXf::Zero(rows, parts)), area(Eigen::VectorXd::Zero(parts)) {}
    void add(int part, const PatchDeviations& x, Eigen::Index patch, double sign, double patch_area) {
        deviations.col(part) += static_cast<float>(sign) * x.col(patch);
        area(part) += sign * patch_area;
    }
};

/// |S|^2 / area of each part, and what it becomes when a patch leaves or joins.
struct Spread {
    Eigen::VectorXf squares;  ///< |S|^2 of each part
    const Eigen::VectorXd& area;

    [[nodiscard]] double now(int part) const { return area(part) > 0.0 ? squares(part) / area(part) : 0.0; }
    /// product: S . x; own: x . x; sign: 1 joins, -1 leaves. A part left without area counts 0.
    [[nodiscard]] double change(int part, double sign, double product, double own, double patch_area) const {
        const double after = area(part) + sign * patch_area;
        if (after <= 1e-12) return -now(part);
        return (squares(part) + sign * 2.0 * product + own) / after - now(part);
    }
};

struct Move {
    double gain = 1e-7;  ///< least gain: below it is rounding in single precision
    int patch = -1;
    int to = -1;
};

class Moves {
  public:
    Moves(const PartitionObjective& objective, std::vector<int> labels, int parts)
        : objective_(objective),
          labels_(std::move(labels)),
          parts_(parts),
          all_(objective.deviations.rows(), parts),
          of_mesh_(at(objective.meshes), PartSums(objective.deviations.rows(), parts)),
          patches_(at(objective.meshes)),
          share_(Eigen::MatrixXd::Zero(parts, objective.meshes)),
          count_(at(parts), 0) {
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            patches_[at(objective_.mesh_of[i])].push_back(static_cast<int>(i));
            put(static_cast<int>(i), labels_[i], 1.0);
        }
        shares_ = share_.rowwise().sum();
        squares_ = share_.rowwise().squaredNorm();
    }

    MovedPatches run(int rounds) {
        std::vector<bool> done(patches_.size(), false);
        int moved = 0;
        for (int round = 0; round < rounds; ++round) {
            pooled_squares_ = weighted_squares(all_, objective_.pooled);
            std::vector<Move> moves;
            for (std::size_t m = 0; m < patches_.size(); ++m) {
                const Move move = done[m] ? Move{} : best_move(m);
                done[m] = move.patch < 0;
                if (move.patch >= 0) moves.push_back(move);
            }
            if (moves.empty()) break;
            for (const Move& move : moves) moved += apply(move);
        }
        return {std::move(labels_), moved};
    }

  private:
    static Eigen::VectorXf weighted_squares(const PartSums& sums, const Eigen::VectorXf& weight) {
        return (sums.deviations.array().square().colwise() * weight.array()).colwise().sum().transpose();
    }

    void put(int patch, int part, double sign) {
        const auto i = at(patch);
        const int mesh = objective_.mesh_of[i];
        all_.add(part, objective_.deviations, patch, sign, objective_.area[i]);
        of_mesh_[at(mesh)].add(part, objective_.deviations, patch, sign, objective_.area[i]);
        share_(part, mesh) += sign * objective_.share[i];
        count_[at(part)] += sign > 0.0 ? 1 : -1;
    }

    /// Moves whose part has lost its other patches since they were found are left out.
    int apply(const Move& move) {
        const int from = labels_[at(move.patch)];
        if (count_[at(from)] == 1) return 0;
        const int mesh = objective_.mesh_of[at(move.patch)];
        put(move.patch, from, -1.0);
        put(move.patch, move.to, 1.0);
        labels_[at(move.patch)] = move.to;
        const double share = objective_.share[at(move.patch)];
        squares_(from) += share * share - 2.0 * share * (share_(from, mesh) + share);
        squares_(move.to) += 2.0 * share * share_(move.to, mesh) - share * share;
        shares_(from) -= share;
        shares_(move.to) += share;
        return 1;
    }

    /// What size steadiness gains when the share of a part in a mesh changes by `change`.
    [[nodiscard]] double size_gain(int part, int mesh, double change) const {
        const double before = relative_variance(shares_(part), squares_(part), objective_.meshes);
        const double squares = squares_(part) + change * (2.0 * share_(part, mesh) + change);
        const double after = relative_variance(shares_(part) + change, squares, objective_.meshes);
        return objective_.size_weight * (before - after);
    }

    /// The gains of a patch's ties to each part. Empty where all ties are to its own part.
    [[nodiscard]] std::vector<double> tied_parts(int patch) const {
        std::vector<double> gain(at(parts_), 0.0);
        bool is_at_border = false;
        for_each_tie(objective_, patch, [&](int other, double tie) {
            gain[at(labels_[at(other)])] += tie;
            is_at_border = is_at_border || labels_[at(other)] != labels_[at(patch)];
        });
        if (!is_at_border) gain.clear();
        return gain;
    }

    [[nodiscard]] Move best_move(std::size_t m) const {
        const PartSums& sums = of_mesh_[m];
        const Spread own{weighted_squares(sums, objective_.per_mesh), sums.area};
        const Spread pooled{pooled_squares_, all_.area};
        Move best;
        for (const int i : patches_[m]) {
            const std::vector<double> tied = tied_parts(i);
            const int from = labels_[at(i)];
            if (tied.empty() || count_[at(from)] == 1) continue;
            const Eigen::VectorXf x = objective_.deviations.col(i);
            const Eigen::VectorXf own_x = x.cwiseProduct(objective_.per_mesh);
            const Eigen::VectorXf pooled_x = x.cwiseProduct(objective_.pooled);
            const Eigen::VectorXf own_products = sums.deviations.transpose() * own_x;
            const Eigen::VectorXf pooled_products = all_.deviations.transpose() * pooled_x;
            const double own_square = x.dot(own_x);
            const double pooled_square = x.dot(pooled_x);
            const auto gain = [&](int part, double sign) {
                return sign * tied[at(part)] +
                       own.change(part, sign, own_products(part), own_square, objective_.area[at(i)]) +
                       pooled.change(part, sign, pooled_products(part), pooled_square,
                                     objective_.area[at(i)]) +
                       size_gain(part, static_cast<int>(m), sign * objective_.share[at(i)]);
            };
            const double leaving = gain(from, -1.0);
            for (int part = 0; part < parts_; ++part) {
                if (part == from || tied[at(part)] <= 0.0) continue;
                const double total = leaving + gain(part, 1.0);
                if (total > best.gain) best = {total, i, part};
            }
        }
        return best;
    }

    const PartitionObjective& objective_;
    std::vector<int> labels_;
    int parts_;
    PartSums all_;
    std::vector<PartSums> of_mesh_;
    std::vector<std::vector<int>> patches_;  ///< of each mesh
    Eigen::MatrixXd share_;                  ///< K x M: of the mesh's area
    std::vector<int> count_;                 ///< patches of each part
    Eigen::VectorXd shares_;                 ///< K: sums of share_ over meshes, as size_gain needs them
    Eigen::VectorXd squares_;                ///< K: sums of their squares
    Eigen::VectorXf pooled_squares_;         ///< K: of all_, as the round began
};

}  // namespace

MovedPatches move_patches(const PartitionObjective& objective, std::vector<int> labels, int parts,
                          int rounds) {
    return Moves(objective, std::move(labels), parts).run(rounds);
}

}  // namespace coseg
