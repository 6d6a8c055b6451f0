#include "mpi_drivers/editing/linked_places.hpp"

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {
namespace {

/// Places of one mesh each, in three parts that all meshes may have.
struct Linked {
    std::vector<LinkedPlace> places;
    std::vector<PlaceLink> links;
    Eigen::MatrixXi allowed;
    std::vector<std::vector<std::string>> why;

    explicit Linked(const std::vector<Eigen::Vector3d>& scores) {
        for (std::size_t p = 0; p < scores.size(); ++p)
            places.push_back({static_cast<int>(p), -1, "", scores[p]});
        allowed = Eigen::MatrixXi::Ones(3, static_cast<Eigen::Index>(scores.size()));
        why.assign(3, std::vector<std::string>(scores.size()));
    }
    void link(int a, int b, bool same) {
        links.push_back({a, b, same, "link " + std::to_string(links.size())});
    }
    [[nodiscard]] std::vector<int> parts() const { return parts_of_places(places, links, allowed, why); }
    [[nodiscard]] std::string sentence() const {
        try {
            static_cast<void>(parts());
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
};

TEST(LinkedPlaces, MustLinksAreDecidedTogether) {
    Linked linked({{0.9, 0.1, 0.0}, {0.0, 0.6, 0.4}, {0.0, 0.6, 0.4}});
    linked.link(0, 1, true);
    EXPECT_EQ(linked.parts(), (std::vector<int>{0, 0, 1}));
    linked.link(2, 1, true);
    EXPECT_EQ(linked.parts(), (std::vector<int>{1, 1, 1}));
}

TEST(LinkedPlaces, OfTwoThatMustDifferTheClearerKeepsItsPart) {
    Linked linked({{0.5, 0.4, 0.0}, {0.9, 0.1, 0.0}});
    linked.link(0, 1, false);
    EXPECT_EQ(linked.parts(), (std::vector<int>{1, 0}));
}

TEST(LinkedPlaces, LeaveTheOthersAWay) {
    // The two clear places would take 0 and 1. This leaves 2 alone for the third, which may not have it.
    Linked linked({{0.9, 0.8, 0.7}, {0.1, 0.9, 0.0}, {0.3, 0.3, 0.3}});
    linked.link(0, 1, false);
    linked.link(1, 2, false);
    linked.link(0, 2, false);
    linked.allowed(2, 2) = 0;
    const std::vector<int> parts = linked.parts();
    EXPECT_NE(parts[0], parts[1]);
    EXPECT_NE(parts[1], parts[2]);
    EXPECT_NE(parts[0], parts[2]);
    EXPECT_NE(parts[2], 2);
}

TEST(LinkedPlaces, WhatIsSaidCountsMoreThanScores) {
    Linked linked({{0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}});
    linked.places[0].said = 2;
    linked.places[0].said_by = "act 4";
    linked.link(0, 1, true);
    EXPECT_EQ(linked.parts(), (std::vector<int>{2, 2}));
}

TEST(LinkedPlaces, ContradictionsNameBothActs) {
    Linked joined({{0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}});
    joined.link(0, 1, true);
    joined.link(1, 0, false);
    EXPECT_EQ(joined.sentence(), "link 1 and link 0 contradict each other: must-links join the two places");

    Linked said({{0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}});
    said.link(0, 1, true);
    said.places[0] = {0, 1, "act 1", said.places[0].scores};
    said.places[1] = {1, 2, "act 2", said.places[1].scores};
    EXPECT_EQ(said.sentence().find("act 1 and act 2 contradict each other"), 0U);

    Linked absent({{0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}});
    absent.link(0, 1, true);
    absent.places[0] = {0, 1, "act 1", absent.places[0].scores};
    absent.allowed(1, 1) = 0;
    absent.why[1][1] = "act 3";
    EXPECT_EQ(absent.sentence().find("act 1 and act 3 contradict each other"), 0U);

    Linked crowded({{0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}, {0.9, 0.1, 0.0}});
    for (int a = 0; a < 4; ++a) {
        for (int b = a + 1; b < 4; ++b) crowded.link(a, b, false);
    }
    EXPECT_NE(crowded.sentence().find("too few parts"), std::string::npos);
}

}  // namespace
}  // namespace coseg
