#include "src/measures/piece_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "src/base/seeded_random.hpp"
#include "src/measures/part_pieces.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

const std::vector<Eigen::Vector3d> leg_places{
    {-0.3, -0.4, -0.2}, {-0.3, -0.4, 0.2}, {0.3, -0.4, -0.2}, {0.3, -0.4, 0.2}};

Eigen::Vector3d shaken(const Eigen::Vector3d& p, SeededStream& random) {
    const auto noise = [&] { return 0.05 * (static_cast<double>(random() % 1000) / 1000.0 - 0.5); };
    return p + Eigen::Vector3d(noise(), noise(), noise());
}

/// Six stools with four legs each, the legs in another order in each, and with these beside: shape 4 lacks
/// its leg 2, and shape 5 has a splinter near leg 0.
std::vector<PartPiece> stools(std::vector<int>& leg_of_piece) {
    SeededStream random(3);
    std::vector<PartPiece> pieces;
    for (int shape = 0; shape < 6; ++shape) {
        for (int k = 0; k < 4; ++k) {
            const int leg = (k + shape) % 4;
            if (shape == 4 && leg == 2) continue;
            const double share = 0.1 + 0.001 * static_cast<double>(random() % 10);
            pieces.push_back({shape, 1, share, shaken(leg_places[static_cast<std::size_t>(leg)], random)});
            leg_of_piece.push_back(leg);
        }
        pieces.push_back({shape, 0, 0.5, {0, 0.1, 0}});
        leg_of_piece.push_back(0);
    }
    pieces.push_back({5, 1, 0.001, leg_places[0]});
    leg_of_piece.push_back(4);
    return pieces;
}

TEST(PieceNumbers, OfLegsAgreeOverTheShapes) {
    std::vector<int> leg_of_piece;
    const std::vector<PartPiece> pieces = stools(leg_of_piece);
    const std::vector<int> numbers = piece_numbers(pieces);
    // The mean places differ in x by 0.6, but by less than the noise within one side: legs 0 and 1 have the
    // numbers 1 and 2 in one order or the other, the same in all shapes.
    std::vector<int> number_of_leg(5, 0);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        int& number = number_of_leg[static_cast<std::size_t>(leg_of_piece[k])];
        if (pieces[k].part == 0) {
            EXPECT_EQ(numbers[k], 1);
            continue;
        }
        if (number == 0) number = numbers[k];
        EXPECT_EQ(numbers[k], number) << "piece " << k;
    }
    EXPECT_EQ(number_of_leg[4], 5);
    EXPECT_LE(std::max(number_of_leg[0], number_of_leg[1]), 2);
    EXPECT_GE(std::min(number_of_leg[2], number_of_leg[3]), 3);
}

TEST(PieceNumbers, DoNotDependOnTheOrderOfPieces) {
    std::vector<int> leg_of_piece;
    const std::vector<PartPiece> pieces = stools(leg_of_piece);
    const std::vector<int> numbers = piece_numbers(pieces);
    const std::vector<PartPiece> backwards(pieces.rbegin(), pieces.rend());
    std::vector<int> backwards_numbers = piece_numbers(backwards);
    std::reverse(backwards_numbers.begin(), backwards_numbers.end());
    EXPECT_EQ(backwards_numbers, numbers);
}

TEST(PieceNumbers, OfLegsThatHangTogetherInMostShapes) {
    std::vector<int> leg_of_piece;
    std::vector<PartPiece> pieces = stools(leg_of_piece);
    const std::vector<int> before = piece_numbers(pieces);
    for (int shape = 6; shape < 16; ++shape) pieces.push_back({shape, 1, 0.4, {0, -0.4, 0}});
    const std::vector<int> numbers = piece_numbers(pieces);
    for (std::size_t k = 0; k < numbers.size(); ++k) EXPECT_EQ(numbers[k], k < before.size() ? before[k] : 1);
}

TEST(PieceNumbers, ByAreaWhereThereAreVeryMany) {
    std::vector<PartPiece> pieces;
    for (int k = 0; k < 150; ++k)
        pieces.push_back({0, 0, 0.001 + 1e-6 * k, Eigen::Vector3d(0.01 * (k % 7), 0, 0)});
    const std::vector<int> numbers = piece_numbers(pieces);
    EXPECT_EQ(numbers.front(), 150);
    EXPECT_EQ(numbers.back(), 1);
}

TEST(PieceNumbers, PiecesOfAShapeHaveSharesAndPlaces) {
    TriMesh far = test::box(1, 1, 1, 2);
    far.vertices.row(0).array() += 3.0;
    const TriMesh boxes = test::disjoint_union(test::box(1, 1, 1, 2), far);
    const std::vector<int> part(static_cast<std::size_t>(boxes.face_count()), 2);
    const std::vector<PartPiece> pieces = pieces_of_shape(9, boxes, part, part_pieces(boxes, part));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[1].shape, 9);
    EXPECT_EQ(pieces[1].part, 2);
    EXPECT_NEAR(pieces[1].share, 0.5, 1e-15);
    // The bounding box is 4 x 1 x 1, its middle at x = 2, its diagonal the root of 18.
    EXPECT_NEAR(pieces[0].place.x(), -1.5 / std::sqrt(18.0), 1e-15);
    EXPECT_NEAR(pieces[1].place.x(), 1.5 / std::sqrt(18.0), 1e-15);
    EXPECT_NEAR(pieces[1].place.y(), 0.0, 1e-15);
}

}  // namespace
}  // namespace coseg
