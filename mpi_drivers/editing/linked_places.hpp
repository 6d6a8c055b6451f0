#pragma once
// Decides the parts of linked places: the same for must-links, different ones for cannot-links, and those
// that are said or not allowed as they are.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace coseg {

/// A place that links join.
struct LinkedPlace {
    int mesh = 0;
    int said = -1;           ///< the part that is said of it, -1: none
    std::string said_by;     ///< which act has said it, for messages
    Eigen::VectorXd scores;  ///< K: how well each part suits it
};

struct PlaceLink {
    int a = 0;  ///< numbers of places
    int b = 0;
    bool same = true;  ///< must-link, or else cannot-link
    std::string text;  ///< for messages
};

/// The part of each place such that all links hold. allowed: K x M, 1 where a mesh may have a part; why_not:
/// K x M texts, which act says that it may not ("" for none), row by row. Places that must have the same part
/// are decided together: those first whose best part is clearest, and each takes the best part that leaves
/// the others a way. Serial. Throws Error(input), naming two acts, where the links contradict each other or
/// what is said.
std::vector<int> parts_of_places(const std::vector<LinkedPlace>& places, const std::vector<PlaceLink>& links,
                                 const Eigen::MatrixXi& allowed,
                                 const std::vector<std::vector<std::string>>& why_not);

}  // namespace coseg
