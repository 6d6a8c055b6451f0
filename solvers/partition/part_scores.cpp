#include "solvers/partition/part_scores.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "solvers/affinity/position_correlation.hpp"
#include "solvers/numeric/blas.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

constexpr float part_ridge = 30.0F;
constexpr int most_groups = 10;
constexpr Eigen::Index most_learnt = 100'000;  // patches; more hardly change a regression of some 500 numbers
constexpr Eigen::Index batch = 2048;           // patches whose products are added at once

/// What a regression over the patches of a group needs.
struct GroupSums {
    int group = 0;
    Eigen::MatrixXf gram;    ///< (D + 4) x (D + 4), sum of weight x x^T
    Eigen::MatrixXf moment;  ///< (D + 4) x K, sum of weight x y^T
    static constexpr auto fields() {
        return std::tuple(field("group", &GroupSums::group), field("gram", &GroupSums::gram),
                          field("moment", &GroupSums::moment));
    }
};

/// The scores of a group's patches are slope^T x.
struct GroupSlope {
    int group = 0;
    Eigen::MatrixXf slope;  ///< (D + 4) x K
    static constexpr auto fields() {
        return std::tuple(field("group", &GroupSlope::group), field("slope", &GroupSlope::slope));
    }
};

class CrossFit {
  public:
    CrossFit(const PatchLooks& looks, const std::vector<int>& part_of_patch, int parts)
        : looks_(looks),
          features_(looks.features.all()),
          places_(correlated_places(looks.frame, looks.positions, features_.cols())),
          part_of_patch_(part_of_patch),
          parts_(parts),
          meshes_(looks.mesh_of.empty() ? 0 : 1 + looks.mesh_of.back()) {
        double sum = 0.0;
        for (const double a : looks.area) sum += a;
        weight_of_area_ = sum > 0.0 ? static_cast<double>(looks.area.size()) / sum : 0.0;
    }

    [[nodiscard]] int groups() const { return std::min(meshes_, most_groups); }

    [[nodiscard]] GroupSums sums(int group) const {
        GroupSums sums{group, Eigen::MatrixXf::Zero(length(), length()),
                       Eigen::MatrixXf::Zero(length(), parts_)};
        const std::vector<Eigen::Index> learnt = patches_of(group, learning_step());
        const auto count = static_cast<Eigen::Index>(learnt.size());
        for (Eigen::Index begin = 0; begin < count; begin += batch) {
            const std::span<const Eigen::Index> some(learnt.data() + begin,
                                                     at(std::min(batch, count - begin)));
            add(some, sums);
        }
        return sums;
    }

    /// The regression over all groups but this one. `all`: the sums over all groups.
    [[nodiscard]] GroupSlope fitted(const GroupSums& all, const GroupSums& left_out) const {
        Eigen::MatrixXf gram = all.gram - left_out.gram;
        gram.diagonal().array() += part_ridge;
        const Eigen::MatrixXf moment = all.moment - left_out.moment;
        const Eigen::LLT<Eigen::MatrixXf> factor(gram);
        if (factor.info() == Eigen::Success) return {left_out.group, factor.solve(moment)};
        return {left_out.group, gram.ldlt().solve(moment)};  // where rounding outweighs the ridge
    }

    void score(const GroupSlope& fit, Eigen::MatrixXf& scores) const {
        const Eigen::MatrixXd slope = fit.slope.cast<double>();
        const Eigen::Index d = features_.rows();
        for (const Eigen::Index i : patches_of(fit.group, 1)) {
            const Eigen::VectorXd value = slope.topRows(d).transpose() * features_.col(i).cast<double>() +
                                          slope.middleRows(d, 3).transpose() * places_.col(i) +
                                          slope.row(d + 3).transpose();
            scores.col(i) = value.cast<float>();
        }
    }

  private:
    [[nodiscard]] Eigen::Index length() const { return features_.rows() + 4; }

    /// Of every how many meshes of a group one is learnt from.
    [[nodiscard]] int learning_step() const {
        return static_cast<int>((features_.cols() + most_learnt - 1) / most_learnt);
    }

    [[nodiscard]] std::vector<Eigen::Index> patches_of(int group, int step) const {
        std::vector<Eigen::Index> patches;
        for (std::size_t i = 0; i < looks_.mesh_of.size(); ++i) {
            const int mesh = looks_.mesh_of[i];
            if (mesh % groups() == group && (mesh / groups()) % step == 0)
                patches.push_back(static_cast<Eigen::Index>(i));
        }
        return patches;
    }

    void add(std::span<const Eigen::Index> patches, GroupSums& sums) const {
        const auto count = static_cast<int>(patches.size());
        const Eigen::Index d = features_.rows();
        Eigen::MatrixXf x(count, length());
        Eigen::MatrixXf y = Eigen::MatrixXf::Zero(count, parts_);
        for (int k = 0; k < count; ++k) {
            const Eigen::Index i = patches[at(k)];
            const auto root = static_cast<float>(std::sqrt(looks_.area[at(i)] * weight_of_area_));
            x.row(k).head(d) = root * features_.col(i).transpose();
            x.row(k).segment<3>(d) = root * places_.col(i).transpose().cast<float>();
            x(k, d + 3) = root;
            y(k, part_of_patch_[at(i)]) = root;
        }
        multiply_transposed(whole(std::as_const(x)), whole(std::as_const(x)), 1.0F, whole(sums.gram));
        multiply_transposed(whole(std::as_const(x)), whole(std::as_const(y)), 1.0F, whole(sums.moment));
    }

    const PatchLooks& looks_;
    SinglePrecisionFeatures::ConstBlock features_;
    Eigen::Matrix3Xd places_;
    const std::vector<int>& part_of_patch_;
    int parts_;
    int meshes_;
    double weight_of_area_ = 0.0;
};

}  // namespace

Eigen::MatrixXf part_scores(const Comm& comm, const PatchLooks& looks, const std::vector<int>& part_of_patch,
                            int parts) {
    const CrossFit fit(looks, part_of_patch, parts);
    if (fit.groups() < 2) return {};
    std::vector<GroupSums> sums;
    agree(comm, [&] {
        for (int g = comm.rank(); g < fit.groups(); g += comm.size()) sums.push_back(fit.sums(g));
    });
    sums = all_gather_records(comm, sums);
    std::sort(sums.begin(), sums.end(), [](const auto& a, const auto& b) { return a.group < b.group; });
    GroupSums all = sums.front();
    for (std::size_t g = 1; g < sums.size(); ++g) {
        all.gram += sums[g].gram;
        all.moment += sums[g].moment;
    }
    std::vector<GroupSlope> slopes;
    agree(comm, [&] {
        for (int g = comm.rank(); g < fit.groups(); g += comm.size())
            slopes.push_back(fit.fitted(all, sums[at(g)]));
    });
    Eigen::MatrixXf scores(parts, looks.features.all().cols());
    for (const GroupSlope& slope : all_gather_records(comm, slopes)) fit.score(slope, scores);
    return scores;
}

}  // namespace coseg
