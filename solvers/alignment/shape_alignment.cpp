#include "solvers/alignment/shape_alignment.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "solvers/alignment/common_frame.hpp"
#include "solvers/alignment/mesh_links_exchange.hpp"
#include "solvers/alignment/pose_rounds.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

constexpr double enough_standing = 0.5;  ///< share of the shapes
constexpr int turning_rounds = 4;
constexpr int freed_rounds = 2;  ///< for shapes that followed a doubtful one
constexpr int settling_rounds = 2;
constexpr int outlier_rounds = 3;
constexpr int similarity_rounds = 8;

double mean_agreement(const std::vector<ShapePose>& poses) {
    double sum = 0.0;
    for (const ShapePose& pose : poses) sum += pose.agreement;
    return sum / static_cast<double>(poses.size());
}

/// "the links agree to .31, as the shapes stand in their files to .11".
std::string agreement_text(const ShapeAlignment& alignment) {
    return "links agree to " + decimal(alignment.agreement_after, 2) +
           ", as the shapes stand in their files to " + decimal(alignment.agreement_before, 2);
}

ShapeAlignment without_poses(ShapeAlignment alignment, const std::string& reason) {
    alignment.shapes.clear();
    alignment.agreement_after = alignment.agreement_before;
    alignment.reason = reason;
    return alignment;
}

/// Of the poses that several beginnings lead to after two rounds, those of the largest agreement. Chains do
/// badly where the links of a pair say little, as of two tables; moments where shapes are alike to many
/// sides.
std::vector<ShapePose> best_beginning(PoseRounds& rounds) {
    constexpr std::uint64_t chains = 2;
    std::vector<ShapePose> best;
    for (std::uint64_t k = 0; k <= chains; ++k) {
        if (k == 0) {
            rounds.start_from_moments();
        } else {
            rounds.start_from_chain(k);
        }
        for (int round = 0; round < 2; ++round) rounds.fit(FitStarts::hashed);
        if (best.empty() || mean_agreement(rounds.poses()) > mean_agreement(best)) best = rounds.poses();
    }
    return best;
}

/// All rotations of the poses, turned by `frame`.
void turn(std::vector<ShapePose>& poses, const Eigen::Matrix3d& frame) {
    for (ShapePose& pose : poses) {
        if (pose.found) pose.rotation = frame * pose.rotation;
    }
}

/// Most shapes stand alike: these stay, and so does their frame. Shapes of which the links say little stand
/// like the others as long as nothing speaks against it.
ShapeAlignment outliers_turned(PoseRounds& rounds, ShapeAlignment alignment) {
    std::vector<ShapePose> poses = rounds.poses();
    for (ShapePose& pose : poses) pose.found = true;
    rounds.set(std::move(poses));
    std::ptrdiff_t turned = 0;
    for (int round = 0; round < outlier_rounds; ++round) {
        rounds.turn_outliers();
        turned = std::count_if(rounds.poses().begin(), rounds.poses().end(),
                               [](const ShapePose& pose) { return pose.is_turned(); });
        if (turned == 0) break;  // another round would find the same
    }
    if (turned == 0)
        return without_poses(alignment,
                             percent(alignment.standing_share, 0) + " stand like the others already");
    alignment.agreement_after = mean_agreement(rounds.poses());
    for (int round = 0; round < similarity_rounds; ++round) rounds.fit_scale_and_translation();
    alignment.shapes = rounds.poses();
    alignment.reason = std::to_string(turned) + " of " + std::to_string(rounds.poses().size()) +
                       " turned to stand like the others: " + agreement_text(alignment);
    return alignment;
}

/// Whose links agree much less than those of others stands by chance: a chair without a back is put on its
/// head if its one foot is linked with backs.
void doubt_where_links_agree_little(std::vector<ShapePose>& poses) {
    const double enough = enough_of_others * median_agreement(poses);
    for (ShapePose& pose : poses) pose.found = pose.found && pose.agreement >= enough;
}

}  // namespace

ShapeAlignment align_shapes(const Comm& comm, const AlignmentInput& input) {
    constexpr std::int64_t most_links = std::int64_t{1} << 30;
    const std::int64_t links = all_sum(comm, std::ssize(input.coefficients.rows));
    if (input.mesh_keys.size() < 2) return without_poses({}, "there is one shape alone");
    if (links > most_links) return without_poses({}, "there are more than 2^30 links");
    const LinksOfMeshes of_meshes =
        links_of_meshes(comm, {input.coefficients, input.mesh_of, input.patch_area, input.mesh_keys});
    PoseRounds rounds(comm, input, of_meshes);
    ShapeAlignment alignment;
    alignment.standing_share = rounds.standing_share();
    alignment.agreement_before = mean_agreement(rounds.poses());
    if (!(alignment.agreement_before > 0.0)) return without_poses(alignment, "no shape has links to others");
    if (shapes_stand_alike(alignment)) return outliers_turned(rounds, std::move(alignment));
    rounds.set(best_beginning(rounds));
    for (int round = 0; round < turning_rounds; ++round) rounds.fit(FitStarts::hashed);
    for (int round = 0; round < 2; ++round) rounds.reflect(clearly_better);
    rounds.turn_doubtful();
    for (int round = 0; round < freed_rounds; ++round) rounds.fit(FitStarts::hashed);
    for (int round = 0; round < settling_rounds; ++round) rounds.fit(FitStarts::none);
    alignment.agreement_after = mean_agreement(rounds.poses());
    if (alignment.agreement_after < clearly_better * alignment.agreement_before)
        return without_poses(alignment, "turned shapes are hardly more alike: " + agreement_text(alignment));
    std::vector<ShapePose> poses = rounds.poses();
    turn(poses, common_frame(poses, {input.positions, input.mesh_of, input.patch_area}));
    rounds.set(poses);
    for (int round = 0; round < similarity_rounds; ++round) rounds.fit_scale_and_translation();
    alignment.shapes = rounds.poses();
    doubt_where_links_agree_little(alignment.shapes);
    alignment.reason = agreement_text(alignment);
    return alignment;
}

bool shapes_stand_alike(const ShapeAlignment& alignment) {
    return alignment.standing_share >= enough_standing;
}

Eigen::Matrix3Xd turned_positions(const ShapePose& pose, const Eigen::Matrix3Xd& positions) {
    ShapeAlignment of_one;
    of_one.shapes = {pose};
    return turned_positions(of_one, positions, std::vector<int>(at(positions.cols()), 0));
}

Eigen::Matrix3Xd turned_positions(const ShapeAlignment& alignment, const Eigen::Matrix3Xd& positions,
                                  const std::vector<int>& mesh_of) {
    if (!alignment.applied()) return positions;
    Eigen::Matrix3Xd turned = positions;
    for (Eigen::Index p = 0; p < turned.cols(); ++p) {
        const ShapePose& pose = alignment.shapes[at(mesh_of[at(p)])];
        turned.col(p) =
            pose.found ? Eigen::Vector3d(pose.rotation * positions.col(p)) : Eigen::Vector3d::Zero();
    }
    return turned;
}

}  // namespace coseg
