#pragma once
// How well one segmentation of a whole collection agrees with the truth.

#include <optional>
#include <string>
#include <vector>

namespace coseg {

/// One shape with its truth and what was found. Labels of the truth and of the answer are numbers that the
/// whole collection shares; the two numberings have nothing to do with each other.
struct LabelledShape {
    std::string name;
    std::vector<int> truth;  ///< F; a face of negative truth counts in the area, never as right
    std::optional<std::vector<int>> labels;  ///< F; none: the shape was not segmented and scores 0
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
    double one_label = 0.0;        ///< one_to_one of one part for the whole collection: the figure to beat
    double rand_index = 0.0;       ///< by area, see src/metrics/rand_index.hpp
    double face_rand_index = 0.0;  ///< by number of faces
    int clusters = 0;              ///< parts that occur in the answer on faces with a truth label
    int truth_labels = 0;          ///< labels that occur in the truth of the shapes that were segmented
    std::vector<ShapeScore> shapes;
};

/// Scores a collection. Accuracy of a shape = area of the faces whose part is mapped to their truth label, over
/// the area of the shape; one mapping serves the whole collection, and every shape weighs the same in it. A part
/// that the one-to-one assignment leaves over is wrong everywhere.
/// Throws Error(input) where lengths differ, an area is negative or not finite, or a shape has no area.
/// Source: accuracy by area, Kalogerakis, Hertzmann, Singh 2010; a single assignment for the whole collection,
/// since the parts of an unsupervised answer have no names.
SegmentationScore score_segmentation(const std::vector<LabelledShape>& shapes);

/// The accuracy of the shape if each of its own labels, e.g. its patches, took the truth label that covers most of it:
/// what no choice of parts for these patches can exceed. In [0, 1]; 0 without labels. Errors as above.
double upper_bound_of_labels(const LabelledShape& shape);

}  // namespace coseg
