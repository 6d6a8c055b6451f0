#pragma once
// Says from which input face each working face came, and carries labels back from working faces to input
// faces.

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// Relates working faces to input faces. Every working face has one input face. An input face has any number
/// of working faces: none if it is degenerate or vanished in remeshing, several if it is a polygon or was
/// refined.
struct FaceMap {
    int input_faces = 0;
    std::vector<int> input_face;  ///< per working face: the input face it came from
    /// Per input face: itself if it has a working face, else the input face whose label it takes.
    std::vector<int> label_donor;
    /// Empty, or per input face: the working face whose label it takes if it has none of its own. With -1 it
    /// takes the label of its label_donor.
    std::vector<int> nearest_working;
    static constexpr auto fields() {
        return std::tuple(
            field("input_faces", &FaceMap::input_faces), field("input_face", &FaceMap::input_face),
            field("label_donor", &FaceMap::label_donor), field("nearest_working", &FaceMap::nearest_working));
    }
};

/// The label of each input face: the one with the largest working area on it, and of equal areas the lowest
/// label. A face without a working face takes the label of nearest_working or that of its label donor. Donors
/// may form chains. working_labels and working_area have one entry per working face. Throws Error(internal)
/// if sizes disagree or a chain of donors does not end.
std::vector<int> carry_labels_back(const FaceMap& map, const std::vector<int>& working_labels,
                                   const Eigen::VectorXd& working_area);

/// For each input face the working face that has most of its area, or the one that it takes its label from.
/// Arguments and errors as above.
std::vector<int> main_working_faces(const FaceMap& map, const Eigen::VectorXd& working_area);

}  // namespace coseg
