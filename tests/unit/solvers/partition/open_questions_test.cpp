#include "solvers/partition/open_questions.hpp"

#include <gtest/gtest.h>

#include "src/base/index.hpp"

namespace coseg {
namespace {

/// Three meshes of two patches of equal size; patches 0, 2 and 4 are tied to each other, and 1, 3 and 5.
PartitionObjective tied_meshes() {
    PartitionObjective objective;
    objective.meshes = 3;
    objective.ties.resize(6);
    for (int i = 0; i < 6; ++i) {
        objective.mesh_of.push_back(i / 2);
        objective.area.push_back(0.5);
        objective.share.push_back(0.5);
        for (int j = i % 2; j < 6; j += 2) {
            if (j != i) objective.ties[at(i)].push_back({j, 1.0});
        }
        objective.ties[at(i)].push_back({i ^ 1, 5.0});  // inside the mesh, which does not count
    }
    return objective;
}

TEST(OpenQuestions, AddWhatIsInDoubtHereToWhatLeansOnIt) {
    const std::vector<bool> open(3, false);
    const auto questions = open_questions(tied_meshes(), {0.5, 1.0, 0.6, 1.0, 1.0, 0.8}, open);
    // Of mesh 0: .5 * .5; patch 2 of mesh 1 leans on it by half: .5 * .4 * .5 * .5.
    EXPECT_NEAR(questions[0].own, 0.25, 1e-12);
    EXPECT_NEAR(questions[0].others, 0.05, 1e-12);
    EXPECT_EQ(questions[0].followers, 1);
    EXPECT_EQ(questions[0].patch, 0);
    EXPECT_NEAR(questions[1].own, 0.2, 1e-12);
    EXPECT_NEAR(questions[1].others, 0.5 * 0.5 * 0.5 * 0.4, 1e-12);
    // Nobody is in doubt where patch 5 is.
    EXPECT_NEAR(questions[2].own, 0.1, 1e-12);
    EXPECT_EQ(questions[2].others, 0.0);
    EXPECT_EQ(questions[2].patch, 5);
    EXPECT_EQ(next_question(questions, open), 0);
}

TEST(OpenQuestions, LeaveOutWhatIsClosed) {
    const std::vector<bool> closed = {true, false, false};
    const auto questions = open_questions(tied_meshes(), {0.5, 1.0, 0.6, 1.0, 1.0, 0.8}, closed);
    EXPECT_EQ(questions[0].value(), 0.0);
    EXPECT_EQ(questions[1].others, 0.0) << "mesh 0 does not follow any more";
    EXPECT_EQ(next_question(questions, closed), 1);
    EXPECT_EQ(next_question(questions, {true, true, true}), -1);
}

}  // namespace
}  // namespace coseg
