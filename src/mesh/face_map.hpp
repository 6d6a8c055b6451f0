#pragma once
// Which input face a working face came from, and the way back for labels.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Working faces <-> input faces. Every working face has one input face; an input face has any number of
/// working faces (none if it is degenerate or vanished in remeshing, several if it is a polygon or was refined).
struct FaceMap {
    int input_faces = 0;
    std::vector<int> input_face;   ///< per working face: the input face it came from
    std::vector<int> label_donor;  ///< per input face: itself if it has a working face, else the input face
                                   ///< whose label it takes
    std::vector<int>
        nearest_working;  ///< empty, or per input face: the working face whose label it takes if it has
                          ///< none of its own; -1: that of its stand-in
};

/// One label per input face: the label with the largest working area on it, ties to the lowest label; faces
/// without a working face take the label of nearest_working or their stand-in's (stand-ins may form chains).
/// working_labels and working_area have one entry per working face.
/// Throws Error(internal) if sizes disagree or a chain of stand-ins ends nowhere.
std::vector<int> carry_labels_back(const FaceMap& map, const std::vector<int>& working_labels,
                                   const Eigen::VectorXd& working_area);

}  // namespace coseg
