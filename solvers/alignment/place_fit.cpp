#include "solvers/alignment/place_fit.hpp"

#include <algorithm>

#include "solvers/alignment/rotation_fit.hpp"

namespace coseg {

namespace {

constexpr double coarse_widths_of_places[] = {0.8, 0.6, 0.45};
constexpr double fine_widths_of_places[] = {0.35, 0.3, 0.3, 0.3};
constexpr double last_width = 0.3;
constexpr double least_density = 0.02;  ///< a place far from all others counts as this much

struct PlaceMotion {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    double likelihood = 0.0;
};

/// Of each own place, moved, and each other one: weight of the other * exp(-d^2 / 2 width^2).
Eigen::MatrixXd densities(const WeighedPlaces& own, const WeighedPlaces& others, const PlaceMotion& motion,
                          double width) {
    const double factor = -0.5 / (width * width);
    const Eigen::Matrix3Xd moved = (motion.rotation * own.positions).colwise() + motion.translation;
    Eigen::MatrixXd found(moved.cols(), others.positions.cols());
    for (Eigen::Index q = 0; q < found.cols(); ++q) {
        const Eigen::VectorXd squares = (moved.colwise() - others.positions.col(q)).colwise().squaredNorm();
        found.col(q) = others.weight[q] * (factor * squares.array()).exp();
    }
    return found;
}

/// The motion that suits best where an own place corresponds to all others, in proportion to their densities.
PlaceMotion next_motion(const WeighedPlaces& own, const WeighedPlaces& others, const PlaceMotion& motion,
                        double width) {
    Eigen::MatrixXd soft = densities(own, others, motion, width);
    const Eigen::VectorXd density = soft.rowwise().sum();
    soft.array().colwise() *= own.weight.array() / (density.array() + least_density);
    const Eigen::VectorXd of_own = soft.rowwise().sum();
    const Eigen::VectorXd of_others = soft.colwise().sum().transpose();
    const double total = of_own.sum();
    if (!(total > 0.0)) return motion;
    const Eigen::Vector3d own_centre = own.positions * of_own / total;
    const Eigen::Vector3d other_centre = others.positions * of_others / total;
    const Eigen::Matrix3Xd own_arms = own.positions.colwise() - own_centre;
    const Eigen::Matrix3Xd other_arms = others.positions.colwise() - other_centre;
    const Eigen::Matrix3Xd drawn = other_arms * soft.transpose();
    PlaceMotion next;
    next.rotation = nearest_rotation(drawn.lazyProduct(own_arms.transpose()));
    next.translation = other_centre - next.rotation * own_centre;
    return next;
}

double likelihood_of(const WeighedPlaces& own, const WeighedPlaces& others, const PlaceMotion& motion) {
    const Eigen::VectorXd density = densities(own, others, motion, last_width).rowwise().sum();
    return (own.weight.array() * (density.array() + least_density).log()).sum();
}

}  // namespace

std::vector<FittedPlaces> fitted_places(const WeighedPlaces& own, const WeighedPlaces& others,
                                        const std::vector<Eigen::Matrix3d>& starts) {
    std::vector<PlaceMotion> candidates;
    for (const Eigen::Matrix3d& start : starts) {
        PlaceMotion motion;
        motion.rotation = start;
        for (const double width : coarse_widths_of_places) motion = next_motion(own, others, motion, width);
        motion.likelihood = likelihood_of(own, others, motion);
        candidates.push_back(motion);
    }
    const auto likelier = [](const PlaceMotion& a, const PlaceMotion& b) {
        return a.likelihood > b.likelihood;
    };
    std::stable_sort(candidates.begin(), candidates.end(), likelier);
    candidates.resize((candidates.size() + 3) / 4);
    for (PlaceMotion& candidate : candidates) {
        for (const double width : fine_widths_of_places)
            candidate = next_motion(own, others, candidate, width);
        candidate.likelihood = likelihood_of(own, others, candidate);
    }
    std::stable_sort(candidates.begin(), candidates.end(), likelier);
    std::vector<FittedPlaces> found;
    for (const PlaceMotion& candidate : candidates)
        found.push_back({candidate.rotation, candidate.likelihood});
    return found;
}

}  // namespace coseg
