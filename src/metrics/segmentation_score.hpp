#pragma once
// Measures how well one segmentation of a whole collection agrees with the truth.

#include <optional>
#include <string>
#include <vector>

namespace coseg {

/// One shape with its true labels and those that were found. The labels of the truth are numbers that the
/// whole collection shares, and so are those of the answer. The two numberings are independent of each other.
struct LabelledShape {
    std::string name;
    std::vector<int> truth;  ///< F; a face of negative truth counts in the area, never as right
    std::optional<std::vector<int>> labels;  ///< F; none if the shape was not segmented, which scores 0
    std::vector<double> face_area;           ///< F, any unit; may be empty where labels is none
};

/// Shares in [0, 1]; all 0 for a shape without labels.
struct ShapeScore {
    std::string name;
    bool missing = false;
    double one_to_one = 0.0;
    double many_to_one = 0.0;
    double one_label = 0.0;
    double rand_index = 0.0;
    double face_rand_index = 0.0;
};

/// Means over all shapes; those without labels count as 0.
struct SegmentationScore {
    double one_to_one = 0.0;       ///< accuracy under the one assignment that is best over the collection
    double many_to_one = 0.0;      ///< accuracy if each part takes the label that covers most of its area
    double one_label = 0.0;        ///< one_to_one of a single part for everything: the figure to beat
    double rand_index = 0.0;       ///< by area, see src/metrics/rand_index.hpp
    double face_rand_index = 0.0;  ///< by number of faces
    int clusters = 0;              ///< parts that occur in the answer on faces with a truth label
    int truth_labels = 0;          ///< labels that occur in the truth of the shapes that were segmented
    std::vector<ShapeScore> shapes;
};

/// Scores a collection. The accuracy of a shape is the area of the faces whose part is mapped to their true
/// label, divided by the area of the shape. One mapping serves the whole collection, and every shape has the
/// same weight in it. A part that the one-to-one assignment leaves over is wrong everywhere. Throws
/// Error(input) where lengths differ, an area is negative or not finite, or a shape has no area.
/// Source: accuracy by area, Kalogerakis, Hertzmann, Singh 2010. The assignment is one for the whole
/// collection because the parts of an unsupervised answer have no names.
SegmentationScore score_segmentation(const std::vector<LabelledShape>& shapes);

/// The accuracy of the shape if each of its own labels, for example its patches, took the true label that
/// covers most of it. No choice of parts for these patches can exceed it. In [0, 1]; 0 without labels. Errors
/// as above.
double upper_bound_of_labels(const LabelledShape& shape);

}  // namespace coseg
