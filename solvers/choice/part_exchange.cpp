#include "solvers/choice/part_exchange.hpp"

#include <Eigen/Core>
#include <utility>

#include "src/base/index.hpp"
#include "src/metrics/assignment.hpp"

namespace coseg {

namespace {

/// An assignment must gain this much; below it is rounding in single precision.
constexpr double least_exchange_gain = 1e-6;

/// The pieces of a mesh, or the parts over several meshes.
struct PieceSums {
    Eigen::MatrixXf deviations;  ///< D x K, times the root of the weight of each row
    Eigen::VectorXd area;        ///< K
    PieceSums(Eigen::Index rows, int parts)
        : deviations(Eigen::MatrixXf::Zero(rows, parts)), area(Eigen::VectorXd::Zero(parts)) {}
};

class PartExchange {
  public:
    PartExchange(const PartitionObjective& objective, std::vector<int> labels, int parts)
        : objective_(objective),
          labels_(std::move(labels)),
          parts_(parts),
          patches_(patches_of_meshes(objective)),
          all_(objective.deviations.rows(), parts),
          share_(Eigen::MatrixXd::Zero(parts, objective.meshes)) {
        for (int m = 0; m < objective_.meshes; ++m) {
            const PieceSums pieces = pieces_of(m);
            all_.deviations += pieces.deviations;
            all_.area += pieces.area;
        }
        for (std::size_t i = 0; i < labels_.size(); ++i)
            share_(labels_[i], objective_.mesh_of[i]) += objective_.share[i];
    }

    std::vector<int> run(int rounds) {
        for (int round = 0; round < rounds; ++round) {
            bool changed = false;
            for (int m = 0; m < objective_.meshes; ++m) changed = exchange(m) || changed;
            if (!changed) break;
        }
        return std::move(labels_);
    }

  private:
    [[nodiscard]] PieceSums pieces_of(int mesh) const {
        PieceSums sums(objective_.deviations.rows(), parts_);
        const BlockRange range = patches_[at(mesh)];
        for (auto i = range.begin; i < range.end; ++i) {
            sums.deviations.col(labels_[at(i)]) += objective_.deviations.col(i);
            sums.area(labels_[at(i)]) += objective_.area[at(i)];
        }
        sums.deviations.array().colwise() *= objective_.pooled.array().sqrt();
        return sums;
    }

    /// What each piece of the mesh (row) gains by links to other meshes in each part (column).
    [[nodiscard]] Eigen::MatrixXd link_gains(int mesh) const {
        Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(parts_, parts_);
        const BlockRange range = patches_[at(mesh)];
        for (auto i = range.begin; i < range.end; ++i) {
            for_each_tie(objective_, static_cast<int>(i), [&](int other, double gain) {
                if (objective_.mesh_of[at(other)] != mesh) gains(labels_[at(i)], labels_[at(other)]) += gain;
            });
        }
        return gains;
    }

    /// What piece `piece` of the mesh is worth in part `part` of the other meshes.
    [[nodiscard]] double worth(const PieceSums& rest, const PieceSums& pieces, int mesh, int piece,
                               int part) const {
        const double area = rest.area(part) + pieces.area(piece);
        const double explained =
            area > 0.0 ? (rest.deviations.col(part) + pieces.deviations.col(piece)).squaredNorm() / area
                       : 0.0;
        const double before = share_(part, mesh);
        const double after = share_(piece, mesh);
        const double sum = share_.row(part).sum() - before + after;
        const double squares = share_.row(part).squaredNorm() - before * before + after * after;
        return explained - objective_.size_weight * relative_variance(sum, squares, objective_.meshes);
    }

    bool exchange(int mesh) {
        const PieceSums pieces = pieces_of(mesh);
        PieceSums rest = all_;
        rest.deviations -= pieces.deviations;
        rest.area -= pieces.area;
        Eigen::MatrixXd gain = link_gains(mesh);
        for (int piece = 0; piece < parts_; ++piece) {
            for (int part = 0; part < parts_; ++part)
                gain(piece, part) += worth(rest, pieces, mesh, piece, part);
        }
        const std::vector<int> part_of = best_assignment(gain);
        double raised = 0.0;
        for (int piece = 0; piece < parts_; ++piece)
            raised += gain(piece, part_of[at(piece)]) - gain(piece, piece);
        if (!(raised > least_exchange_gain)) return false;
        apply(mesh, part_of, rest, pieces);
        return true;
    }

    void apply(int mesh, const std::vector<int>& part_of, const PieceSums& rest, const PieceSums& pieces) {
        const Eigen::VectorXd share = share_.col(mesh);
        all_ = rest;
        for (int piece = 0; piece < parts_; ++piece) {
            const int part = part_of[at(piece)];
            all_.deviations.col(part) += pieces.deviations.col(piece);
            all_.area(part) += pieces.area(piece);
            share_(part, mesh) = share(piece);
        }
        const BlockRange range = patches_[at(mesh)];
        for (auto i = range.begin; i < range.end; ++i) labels_[at(i)] = part_of[at(labels_[at(i)])];
    }

    const PartitionObjective& objective_;
    std::vector<int> labels_;
    int parts_;
    std::vector<BlockRange> patches_;
    PieceSums all_;          ///< of the parts
    Eigen::MatrixXd share_;  ///< K x M: of the mesh's area
};

}  // namespace

std::vector<int> exchange_parts(const PartitionObjective& objective, std::vector<int> labels, int parts,
                                int rounds) {
    return PartExchange(objective, std::move(labels), parts).run(rounds);
}

}  // namespace coseg
