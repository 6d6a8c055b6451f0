#pragma once
// Reads back the shapes of a finished run with their labels, and shares them out among the ranks.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "io/folders/finished_run.hpp"
#include "src/mesh/polygon_mesh.hpp"
#include "src/parallel/comm.hpp"
#include "src/pictures/picture_mesh.hpp"

namespace coseg {

struct LabelledMesh {
    int number = 0;  ///< in the run
    std::string name;
    std::string path;
    PolygonMesh mesh;
    std::vector<int> part;   ///< per face of the file
    std::vector<int> patch;  ///< likewise
    std::vector<int> truth;  ///< likewise; empty where there is none
    /// By which the run turned the shape to stand like the others (alignment.json); else the identity.
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    /// Its label files that are not as the run wrote them.
    std::vector<std::string> changed_files;
};

struct FinishedInput {
    std::string folder;  ///< of the run
    /// Where the meshes are now; empty if they are where the run found them.
    std::vector<std::string> meshes;
    std::string truth;  ///< the folder of NAME.seg; empty if there is none
};

/// The run's report on every rank. Prints a warning if it is not as the run wrote it. Collective; throws
/// AgreedError(input).
FinishedRun read_run(const Comm& comm, const std::string& folder);

/// This rank's share of the shapes, ascending by number: every shape whose number is the rank modulo the
/// number of ranks. Prints a warning if label files are not as the run wrote them: damaged, or edited, which
/// is the user's right. Collective; throws AgreedError(input) if a mesh is gone, has another number of
/// faces than it was segmented with, or labels that the run did not have.
std::vector<LabelledMesh> read_shapes(const Comm& comm, const FinishedRun& run, const FinishedInput& input);

/// The shape as it stands beside the others: turned by its rotation. One colour per face of the file.
PictureMesh standing_picture(const LabelledMesh& shape, const std::vector<Color>& color_of_face);

/// The true label for which each part stands, K entries. It is the one-to-one assignment that covers the most
/// area over all shapes with truth (where each shape has the same weight), as in `coseg score`; -1 for a part
/// left over. Collective; throws AgreedError(input) if no shape has truth.
std::vector<int> agree_on_truth(const Comm& comm, const std::vector<LabelledMesh>& shapes, int parts);

/// For each face whether its part does not stand for its true label; so for a face without one. None is wrong
/// where the shape has no truth. `label_of_part` is that of agree_on_truth.
std::vector<bool> wrong_faces(const LabelledMesh& shape, const std::vector<int>& label_of_part);

/// The share of the shape's area whose faces are not wrong; nothing where it has no area.
std::optional<double> right_share(const LabelledMesh& shape, const std::vector<bool>& is_wrong);

}  // namespace coseg
