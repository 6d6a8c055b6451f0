#pragma once
// Fits the pose of each shape against the others, round by round.

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "solvers/alignment/mesh_links_exchange.hpp"
#include "solvers/alignment/place_fit.hpp"
#include "solvers/alignment/rotation_fit.hpp"
#include "solvers/alignment/shape_alignment.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// The median of the agreements, of two in the middle the larger. At least one pose.
double median_agreement(const std::vector<ShapePose>& poses);

/// The pose of a shape among others that stand alike: the rotation is taken only where links agree
/// outlier_gain times as well with it, and at least to `enough`.
ShapePose turned_if_outlier(ShapePose as_it_stands, const FittedRotation& best, double enough);

/// From where else than its own pose a shape is fitted.
enum class FitStarts {
    none,
    hashed,  ///< half of the shapes in turns: if all were free at once, two could follow each other for ever
};

/// The poses of all shapes, which all ranks hold. In a round every rank fits the shapes of its own against
/// where the others were before, and the ranks tell each other. All steps are collective.
class PoseRounds {
  public:
    /// `input` and `links` must outlive it. The poses begin as the shapes stand in their files.
    PoseRounds(const Comm& comm, const AlignmentInput& input, const LinksOfMeshes& links);

    [[nodiscard]] const std::vector<ShapePose>& poses() const noexcept { return poses_; }
    void set(std::vector<ShapePose> poses) { poses_ = std::move(poses); }

    /// See ShapeAlignment, of the poses as they are.
    [[nodiscard]] double standing_share() const;

    /// Begins anew from pairs of shapes that are fitted and chained (rotation_chain.hpp). Shapes that no
    /// chain reaches stay, and are not found. `choice` decides which pairs.
    void start_from_chain(std::uint64_t choice);
    /// Begins anew from the moments of pairs (spectral_rotations.hpp).
    void start_from_moments();
    void fit(FitStarts starts);
    /// Turns each shape whose links then agree at least twice as well as now, and half as well as those of
    /// the median shape do now; one that was turned before is fitted again. The others stay.
    void turn_outliers();
    /// Reflects a shape where its agreement then is `better` times what it was.
    void reflect(double better);
    /// Turns doubtful shapes to where their patches lie like those of shapes that are not (place_fit.hpp). A
    /// shape is doubtful where its links agree less than .8 times as well as those of the median shape. It
    /// stays where it is linked with less than three that are not, where its links to these would agree less
    /// than a third as well as now, and where the mean logarithm of the density grows by less than .05. Of
    /// turns that are nearly as likely (to .02) it takes the one with which these links agree most.
    void turn_doubtful();
    /// Half a step towards the scale and the translation that suit the others best. The geometric mean of the
    /// scales is 1, and the mean of the translations 0.
    void fit_scale_and_translation();

  private:
    /// Calls made(mesh, links) for each shape of this rank; the poses that come back replace those of all.
    template <class Make>
    void round(Make&& make);
    /// The links of a shape to each of its partners.
    [[nodiscard]] std::map<int, std::vector<PatchLink>> by_partner(const std::vector<PatchLink>& links) const;
    /// As the shapes stand in their files.
    void stand_as_in_files();
    /// The agreement of the poses as they are.
    void measure();
    [[nodiscard]] LinkedPoints points_of(const std::vector<PatchLink>& links) const;
    [[nodiscard]] bool is_in_turn(int mesh) const;
    /// The pose of a shape for turn_outliers; `enough`: the least agreement of a turn that is taken.
    [[nodiscard]] ShapePose turned_outlier(int mesh, const LinkedPoints& points, double enough) const;
    /// The links to shapes whose links agree to `enough`: to those that agree best, if there are many.
    [[nodiscard]] std::map<int, std::vector<PatchLink>> certain_partners(const std::vector<PatchLink>& links,
                                                                         double enough) const;
    /// The pose of a doubtful shape for turn_doubtful; `certain`: its links to shapes that are not.
    [[nodiscard]] ShapePose turned_by_places(int mesh,
                                             const std::map<int, std::vector<PatchLink>>& certain) const;
    /// Adds the patches of a shape, turned as it is, to `places`; the weights are the areas. Of more than 150
    /// patches, as small collections with many over-segmentations have, it takes every second, third, ...
    void append_places(int mesh, const Eigen::Matrix3d& rotation, WeighedPlaces& places) const;
    [[nodiscard]] ShapePose moved(int mesh, const std::vector<PatchLink>& links) const;

    const Comm& comm_;
    const AlignmentInput& input_;
    const LinksOfMeshes& links_;
    std::vector<ShapePose> poses_;
    int turn_ = 0;
};

}  // namespace coseg
