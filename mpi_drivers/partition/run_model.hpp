#pragma once
// DIR/model.h5: what a run keeps so that more shapes can be labelled like its own.

#include <cstdint>
#include <string>
#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/alignment/added_pose.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/position_frame.hpp"

namespace coseg {

inline constexpr const char* model_format = "coseg model";
inline constexpr int model_version = 4;

/// How the patches of a model lie, apart from their features.
struct PatchPlaces {
    std::vector<double> area;                     ///< of each patch
    Eigen::Matrix3Xd positions;                   ///< as in PatchFeatures, turned as the run has turned them
    std::vector<GlobalPatchNeighbors> neighbors;  ///< numbers as in the model
    PositionFrame frame;   ///< of these positions; without correlation where places did not count
    FrameOfShapes shapes;  ///< how a new shape is turned to stand like the run's
    static constexpr auto fields() {
        return std::tuple(field("area", &PatchPlaces::area), field("positions", &PatchPlaces::positions),
                          field("neighbors", &PatchPlaces::neighbors), field("frame", &PatchPlaces::frame),
                          field("shapes", &PatchPlaces::shapes));
    }
};

/// The patches of the run's meshes, or of a hashed sample of 64 of them where the run has more than 128, so
/// that the file stays small for any collection.
struct RunModel {
    /// The options on which descriptions, features, penalties and labels depend; defaults elsewhere.
    RunOptions options;
    std::vector<FeatureBins> bins;            ///< of each feature, in the order of the descriptors
    std::vector<Eigen::MatrixXd> histograms;  ///< as in PatchFeatures, rounded to single precision
    int face_feature_dimensions = 0;      ///< numbers a face that --face-features gave; 0: it was not given
    std::vector<int> mesh_of;             ///< of each patch, 0 .. meshes kept - 1
    std::vector<std::string> mesh_names;  ///< of the meshes kept
    std::vector<int> part_of_patch;
    PatchPlaces places;
    bool same_build = true;  ///< whether this build of coseg has written it
};

/// The patches that a model keeps, and how their features were made.
struct ModelPatches {
    std::vector<Descriptor> descriptors;      ///< as in PatchFeatures
    std::vector<FeatureBins> bins;            ///< likewise
    std::vector<int> meshes;                  ///< of the collection, ascending
    std::vector<int> columns;                 ///< their patches, ascending
    std::vector<Eigen::MatrixXf> histograms;  ///< as in PatchFeatures, of these patches
    PatchPlaces places;                       ///< as the meshes stand in their files, without a frame
};
/// On rank 0, or on all ranks; nothing on the others. Collective.
ModelPatches model_patches(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                           std::uint64_t seed, bool on_all_ranks);

/// The patches where they lie in the common frame, with the frame of the positions there. `positions` are
/// those of all patches of the collection, see linked_positions.
ModelPatches in_frame(ModelPatches patches, const Eigen::Matrix3Xd& positions,
                      const ShapeAlignment& alignment, const PositionFrame& frame);

/// The model that read_run_model gives of what write_run_model writes of the same. Serial.
RunModel run_model(const Collection& collection, const ModelPatches& patches,
                   const std::vector<int>& part_of_patch, const RunOptions& options);

/// Writes the model into the folder on rank 0; only there `patches` is needed. Collective; throws
/// AgreedError(output).
void write_run_model(const Comm& comm, const std::string& folder, const Collection& collection,
                     const ModelPatches& patches, const std::vector<int>& part_of_patch,
                     const RunOptions& options);

/// Features that users give must be given for the run's shapes and for the new ones, or for neither. Throws
/// AgreedError(usage).
void refuse_other_face_features(const RunModel& model, const FeatureOptions& own);
/// Throws AgreedError(input) where the new shapes have another number of them for a face than the run's.
void refuse_other_dimensions(const RunModel& model, const CollectionDescriptors& descriptors);

/// The model of the run in `folder`, on every rank; warns where another build of coseg has made it.
/// Collective; throws AgreedError as read_run_model throws.
RunModel agreed_run_model(const Comm& comm, const std::string& folder, StageLog& log);

/// The model of the run in `folder`. Throws Error(input) where the folder holds no run, the run kept no
/// model, or the model is damaged or of another version.
RunModel read_run_model(const std::string& folder);

}  // namespace coseg
