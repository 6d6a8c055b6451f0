#pragma once
// Numbers the connected pieces of a part so that the numbers agree over a collection of shapes.

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "src/mesh/tri_mesh.hpp"
#include "src/records/fields.hpp"

namespace coseg {

/// One connected piece of a part of a shape.
struct PartPiece {
    int shape = 0;
    int part = 0;
    double share = 0.0;  ///< of the area of the shape
    /// The centroid of its surface, from the middle of the shape's bounding box, in units of its diagonal.
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    static constexpr auto fields() {
        return std::tuple(field("shape", &PartPiece::shape), field("part", &PartPiece::part),
                          field("share", &PartPiece::share), field("place", &PartPiece::place));
    }
};

/// The pieces of a shape, by their number in piece_of_face (part_pieces.hpp).
std::vector<PartPiece> pieces_of_shape(int shape, const TriMesh& mesh, const std::vector<int>& part_of_face,
                                       const std::vector<int>& piece_of_face);

/// The number of each piece in its part and shape, from 1. m is the number of pieces of a part, above 1, that
/// most shapes have: at least one shape in four, else m is 1. Pieces of less than a tenth of the area of the
/// part's largest do not count for this. The mean places of these m are found by assigning the pieces of such
/// shapes to them in turns, and are numbered by their coordinates (x, then y, then z). The pieces of every
/// shape take the numbers of the mean places to which they can be assigned with the least sum of squared
/// distances. What is left over, and all small pieces, are numbered on from m + 1 by decreasing area. So
/// numbers agree where the shapes stand alike, and a shape that lacks a piece lacks its number; but a piece
/// that is the only one, as legs that hang together are, has the number 1. Where m is above 100, all pieces
/// are numbered by decreasing area. The result depends on the pieces alone, not on their order.
std::vector<int> piece_numbers(const std::vector<PartPiece>& pieces);

}  // namespace coseg
