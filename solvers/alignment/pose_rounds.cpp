#include "solvers/alignment/pose_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "solvers/alignment/rotation_chain.hpp"
#include "solvers/alignment/spectral_rotations.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

constexpr int hashed_starts = 24;
constexpr double as_good = 0.9;
constexpr double certain_of_median = 0.8;
constexpr double enough_of_links = 1.0 / 3.0;
constexpr double enough_gain = 0.05;  ///< of the likelihood of places, like the next one
constexpr double nearly_as_likely = 0.02;
constexpr std::size_t least_certain_partners = 3;
constexpr std::size_t most_certain_partners =
    20;  ///< each costs as much as the first and says less that is new
constexpr int place_starts = 120;
constexpr Eigen::Index most_places = 150;  ///< of a shape: time grows with their square
constexpr int pairs_of_a_shape = 4;
constexpr double most_scale = 2.0;

/// Where x of a shape lies in the frame.
Eigen::Vector3d placed(const ShapePose& pose, const Eigen::Vector3d& x) {
    return pose.scale * (pose.rotation * x) + pose.translation;
}

void scale_to_one(Eigen::VectorXd& weight) {
    const double total = weight.sum();
    if (total > 0.0) weight /= total;
}

/// Weighted sums over links of what is at their two ends.
struct EndMoments {
    double weight = 0.0;
    double squares = 0.0;  ///< of the distance
    Eigen::Vector3d own = Eigen::Vector3d::Zero();
    Eigen::Vector3d other = Eigen::Vector3d::Zero();
    double own_spread = 0.0;
    double other_spread = 0.0;
};

/// `points.own` turned, but neither scaled nor moved.
EndMoments moments_of(const LinkedPoints& points, const ShapePose& pose) {
    constexpr double factor = -0.5 / (agreement_width * agreement_width);
    EndMoments sums;
    for (Eigen::Index k = 0; k < points.own.cols(); ++k) {
        const Eigen::Vector3d x = pose.rotation * points.own.col(k);
        const Eigen::Vector3d y = points.other.col(k);
        const double distance = (pose.scale * x + pose.translation - y).squaredNorm();
        const double weight = points.weight[k] * std::exp(factor * distance);
        sums.weight += weight;
        sums.squares += weight * distance;
        sums.own += weight * x;
        sums.other += weight * y;
        sums.own_spread += weight * x.squaredNorm();
        sums.other_spread += weight * y.squaredNorm();
    }
    return sums;
}

double residual_of(const LinkedPoints& points, const ShapePose& pose) {
    const EndMoments sums = moments_of(points, pose);
    return sums.weight > 0.0 ? std::sqrt(sums.squares / sums.weight) : 0.0;
}

/// The scale is the ratio of the spreads: a regression of one end on the other would shrink every shape.
ShapePose half_step(const LinkedPoints& points, ShapePose pose) {
    const EndMoments sums = moments_of(points, pose);
    if (!(sums.weight > 0.0)) return pose;
    const Eigen::Vector3d own = sums.own / sums.weight;
    const Eigen::Vector3d other = sums.other / sums.weight;
    const double own_spread = sums.own_spread / sums.weight - own.squaredNorm();
    const double other_spread = sums.other_spread / sums.weight - other.squaredNorm();
    if (own_spread > 1e-12 && other_spread > 1e-12) {
        const double wanted = std::clamp(std::sqrt(other_spread / own_spread), 1.0 / most_scale, most_scale);
        pose.scale = std::sqrt(pose.scale * wanted);
    }
    pose.translation = 0.5 * (pose.translation + other - pose.scale * own);
    return pose;
}

}  // namespace

double median_agreement(const std::vector<ShapePose>& poses) {
    std::vector<double> agreements;
    for (const ShapePose& pose : poses) agreements.push_back(pose.agreement);
    const auto middle = agreements.begin() + std::ssize(agreements) / 2;
    std::nth_element(agreements.begin(), middle, agreements.end());
    return *middle;
}

ShapePose turned_if_outlier(ShapePose as_it_stands, const FittedRotation& best, double enough) {
    if (best.agreement < outlier_gain * as_it_stands.agreement || best.agreement < enough)
        return as_it_stands;
    as_it_stands.rotation = best.rotation;
    as_it_stands.agreement = best.agreement;
    return as_it_stands;
}

PoseRounds::PoseRounds(const Comm& comm, const AlignmentInput& input, const LinksOfMeshes& links)
    : comm_(comm), input_(input), links_(links), poses_(input.mesh_keys.size()) {
    stand_as_in_files();
    measure();
}

template <class Make>
void PoseRounds::round(Make&& make) {
    std::vector<ShapePose> mine;
    for (std::size_t k = 0; k < links_.links.size(); ++k)
        mine.push_back(make(static_cast<int>(links_.meshes.begin) + static_cast<int>(k), links_.links[k]));
    poses_ = all_gather_records(comm_, mine);
    ++turn_;
}

void PoseRounds::stand_as_in_files() { poses_.assign(poses_.size(), {}); }

void PoseRounds::measure() {
    round([&](int mesh, const std::vector<PatchLink>& links) {
        ShapePose pose = poses_[at(mesh)];
        pose.agreement = agreement(points_of(links), pose.rotation);
        return pose;
    });
}

LinkedPoints PoseRounds::points_of(const std::vector<PatchLink>& links) const {
    const auto count = std::ssize(links);
    LinkedPoints points{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count), Eigen::VectorXd(count)};
    for (Eigen::Index k = 0; k < count; ++k) {
        const PatchLink& link = links[at(k)];
        const int other = input_.mesh_of[at(link.other)];
        points.own.col(k) = input_.positions.col(link.own);
        points.other.col(k) = placed(poses_[at(other)], input_.positions.col(link.other));
        points.weight[k] = link.weight;
    }
    scale_to_one(points.weight);
    return points;
}

bool PoseRounds::is_in_turn(int mesh) const {
    return (hash_words({input_.seed, input_.mesh_keys[at(mesh)]}) & 1U) ==
           (static_cast<unsigned>(turn_) & 1U);
}

double PoseRounds::standing_share() const {
    std::vector<Eigen::Matrix3d> turns = tried_rotations(input_.seed);
    turns.erase(turns.begin());  // the identity
    std::int64_t standing = 0;
    for (const std::vector<PatchLink>& of_mesh : links_.links) {
        const LinkedPoints points = points_of(of_mesh);
        double best = 0.0;
        for (const Eigen::Matrix3d& rotation : turns) best = std::max(best, agreement(points, rotation));
        const double as_it_is = agreement(points, Eigen::Matrix3d::Identity());
        if (as_it_is > 0.0 && as_it_is >= as_good * best) ++standing;
    }
    return static_cast<double>(all_sum(comm_, standing)) / static_cast<double>(poses_.size());
}

std::map<int, std::vector<PatchLink>> PoseRounds::by_partner(const std::vector<PatchLink>& links) const {
    std::map<int, std::vector<PatchLink>> partners;
    for (const PatchLink& link : links) partners[input_.mesh_of[at(link.other)]].push_back(link);
    return partners;
}

void PoseRounds::start_from_chain(std::uint64_t choice) {
    stand_as_in_files();
    std::vector<PairRotation> mine;
    for (std::size_t k = 0; k < links_.links.size(); ++k) {
        const int mesh = static_cast<int>(links_.meshes.begin) + static_cast<int>(k);
        const std::map<int, std::vector<PatchLink>> partners = by_partner(links_.links[k]);
        std::vector<std::pair<std::uint64_t, int>> order;
        for (const auto& [other, list] : partners)
            order.emplace_back(hash_words({choice, input_.mesh_keys[at(mesh)], input_.mesh_keys[at(other)]}),
                               other);
        std::sort(order.begin(), order.end());
        order.resize(std::min(order.size(), std::size_t{pairs_of_a_shape}));
        for (const auto& [key, other] : order) {
            const FittedRotation best =
                fitted(points_of(partners.at(other)), hashed_rotations(hashed_starts, key));
            mine.push_back({mesh, other, best.rotation, best.agreement});
        }
    }
    const ChainedRotations chained =
        chained_rotations(static_cast<int>(std::ssize(poses_)), all_gather_records(comm_, mine));
    for (std::size_t m = 0; m < poses_.size(); ++m) {
        poses_[m].rotation = chained.rotations[m];
        poses_[m].found = chained.reached[m];
    }
}

void PoseRounds::start_from_moments() {
    stand_as_in_files();
    std::vector<PairMoment> mine;
    for (std::size_t k = 0; k < links_.links.size(); ++k) {
        const int mesh = static_cast<int>(links_.meshes.begin) + static_cast<int>(k);
        for (const auto& [other, list] : by_partner(links_.links[k])) {
            const LinkedPoints points = points_of(list);
            mine.push_back({mesh, other, points.own * points.weight.asDiagonal() * points.other.transpose()});
        }
    }
    const std::vector<Eigen::Matrix3d> rotations = spectral_rotations(
        static_cast<int>(std::ssize(poses_)), all_gather_records(comm_, mine), input_.seed);
    for (std::size_t m = 0; m < poses_.size(); ++m) {
        poses_[m].rotation = rotations[m];
        poses_[m].found = true;
    }
}

void PoseRounds::fit(FitStarts starts) {
    round([&](int mesh, const std::vector<PatchLink>& links) {
        ShapePose pose = poses_[at(mesh)];
        if (links.empty()) return pose;
        LinkedPoints points = points_of(links);
        if (pose.reflected) points = mirrored(std::move(points));
        const Eigen::Matrix3d sign = (pose.reflected ? -1.0 : 1.0) * Eigen::Matrix3d::Identity();
        FittedRotation best = fitted_near(points, sign * pose.rotation);
        if (starts == FitStarts::hashed && is_in_turn(mesh)) {
            const std::uint64_t seed =
                hash_words({input_.seed, input_.mesh_keys[at(mesh)], static_cast<std::uint64_t>(turn_)});
            const FittedRotation other = fitted(points, hashed_rotations(hashed_starts, seed));
            if (other.agreement > best.agreement) best = other;
        }
        pose.rotation = sign * best.rotation;
        pose.agreement = best.agreement;
        return pose;
    });
}

ShapePose PoseRounds::turned_outlier(int mesh, const LinkedPoints& points, double enough) const {
    ShapePose pose = poses_[at(mesh)];
    if (pose.is_turned()) {
        const FittedRotation again = fitted_near(points, pose.rotation);
        pose.rotation = again.rotation;
        pose.agreement = again.agreement;
        return pose;
    }
    pose.agreement = agreement(points, pose.rotation);
    const std::uint64_t seed = hash_words({input_.seed, input_.mesh_keys[at(mesh)]});
    return turned_if_outlier(pose, fitted(points, hashed_rotations(hashed_starts, seed)), enough);
}

void PoseRounds::turn_outliers() {
    const double enough = enough_of_others * median_agreement(poses_);
    round([&](int mesh, const std::vector<PatchLink>& links) {
        return links.empty() ? poses_[at(mesh)] : turned_outlier(mesh, points_of(links), enough);
    });
}

void PoseRounds::reflect(double better) {
    round([&](int mesh, const std::vector<PatchLink>& links) {
        ShapePose pose = poses_[at(mesh)];
        if (links.empty() || pose.reflected || !is_in_turn(mesh)) return pose;
        const std::uint64_t seed =
            hash_words({input_.seed, input_.mesh_keys[at(mesh)], static_cast<std::uint64_t>(turn_)});
        const FittedRotation other =
            fitted(mirrored(points_of(links)), hashed_rotations(hashed_starts, seed));
        if (other.agreement < better * pose.agreement) return pose;
        pose.rotation = -other.rotation;
        pose.agreement = other.agreement;
        pose.reflected = true;
        return pose;
    });
}

void PoseRounds::append_places(int mesh, const Eigen::Matrix3d& rotation, WeighedPlaces& places) const {
    const auto [first, last] = std::equal_range(input_.mesh_of.begin(), input_.mesh_of.end(), mesh);
    const auto begin = first - input_.mesh_of.begin();
    const Eigen::Index step = (last - first + most_places - 1) / most_places;
    const Eigen::Index count = step > 0 ? (last - first + step - 1) / step : 0;
    const Eigen::Index before = places.weight.size();
    places.positions.conservativeResize(3, before + count);
    places.weight.conservativeResize(before + count);
    for (Eigen::Index k = 0; k < count; ++k) {
        places.positions.col(before + k) = rotation * input_.positions.col(begin + k * step);
        places.weight[before + k] = input_.patch_area[at(begin + k * step)];
    }
}

ShapePose PoseRounds::turned_by_places(int mesh, const std::map<int, std::vector<PatchLink>>& certain) const {
    ShapePose pose = poses_[at(mesh)];
    const Eigen::Matrix3d sign = (pose.reflected ? -1.0 : 1.0) * Eigen::Matrix3d::Identity();
    WeighedPlaces own;
    WeighedPlaces others;
    std::vector<PatchLink> links;
    append_places(mesh, sign, own);
    for (const auto& [other, list] : certain) {
        append_places(other, poses_[at(other)].rotation, others);
        links.insert(links.end(), list.begin(), list.end());
    }
    scale_to_one(own.weight);
    scale_to_one(others.weight);
    const std::uint64_t seed = hash_words({input_.seed, input_.mesh_keys[at(mesh)]});
    const double now = fitted_places(own, others, {sign * pose.rotation}).front().likelihood;
    const LinkedPoints points = points_of(links);
    double best = enough_of_links * agreement(points, pose.rotation);
    const std::vector<FittedPlaces> found = fitted_places(own, others, hashed_rotations(place_starts, seed));
    for (const FittedPlaces& one : found) {
        if (one.likelihood < std::max(now + enough_gain, found.front().likelihood - nearly_as_likely)) break;
        const double agrees = agreement(points, sign * one.rotation);
        if (agrees < best) continue;
        best = agrees;
        pose.rotation = sign * one.rotation;
    }
    return pose;
}

std::map<int, std::vector<PatchLink>> PoseRounds::certain_partners(const std::vector<PatchLink>& links,
                                                                   double enough) const {
    std::map<int, std::vector<PatchLink>> partners = by_partner(links);
    std::erase_if(partners, [&](const auto& one) { return poses_[at(one.first)].agreement < enough; });
    while (partners.size() > most_certain_partners) {
        partners.erase(std::min_element(partners.begin(), partners.end(), [&](const auto& a, const auto& b) {
            return poses_[at(a.first)].agreement < poses_[at(b.first)].agreement;
        }));
    }
    return partners;
}

void PoseRounds::turn_doubtful() {
    const double enough = certain_of_median * median_agreement(poses_);
    round([&](int mesh, const std::vector<PatchLink>& links) {
        const ShapePose& pose = poses_[at(mesh)];
        if (pose.agreement >= enough || links.empty()) return pose;
        const std::map<int, std::vector<PatchLink>> certain = certain_partners(links, enough);
        return certain.size() < least_certain_partners ? pose : turned_by_places(mesh, certain);
    });
}

ShapePose PoseRounds::moved(int mesh, const std::vector<PatchLink>& links) const {
    const LinkedPoints points = points_of(links);
    ShapePose pose = half_step(points, poses_[at(mesh)]);
    pose.residual = residual_of(points, pose);
    return pose;
}

void PoseRounds::fit_scale_and_translation() {
    round([&](int mesh, const std::vector<PatchLink>& links) {
        return poses_[at(mesh)].found ? moved(mesh, links) : poses_[at(mesh)];
    });
    double logarithms = 0.0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (const ShapePose& pose : poses_) {
        if (!pose.found) continue;
        logarithms += std::log(pose.scale);
        mean += pose.translation;
        count += 1.0;
    }
    const double scale = std::exp(-logarithms / count);
    for (ShapePose& pose : poses_) {
        if (!pose.found) continue;
        pose.scale *= scale;
        pose.translation = scale * (pose.translation - mean / count);
    }
}

}  // namespace coseg
