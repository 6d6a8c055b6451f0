#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>

#include "src/parallel/record_exchange.hpp"
#include "tests/support/subspace_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

/// A folder of rank 0's that all ranks know.
class SharedFolder {
  public:
    explicit SharedFolder(const Comm& comm) : comm_(comm) {
        std::vector<std::string> path;
        if (comm.is_root()) path = {own_.path("state")};
        broadcast(comm, path);
        path_ = path.front();
    }
    ~SharedFolder() { MPI_Barrier(comm_.raw()); }  // before the folder goes with rank 0's
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    const Comm& comm_;
    test::TemporaryFolder own_;
    std::string path_;
};

/// The checkpoint, and a signal to the last rank at its `turns`-th turn.
class SignalledCheckpoint : public SolverCheckpoint {
  public:
    SignalledCheckpoint(const Comm& comm, SolverCheckpoint& inner, int turns)
        : comm_(comm), inner_(inner), turns_(turns) {}
    void open(const SubspaceProblem& problem, const SolveOptions& options, BlockRange owned) override {
        inner_.open(problem, options, owned);
    }
    std::optional<SolvedTile> find(std::int64_t begin) override { return inner_.find(begin); }
    void keep(const SolvedTile& tile) override { inner_.keep(tile); }
    bool should_stop() override { return inner_.should_stop(); }
    std::optional<SolveIterate> find_iterate() override { return inner_.find_iterate(); }
    CheckpointAction turn() override {
        if (--turns_ == 0 && comm_.rank() == comm_.size() - 1) std::raise(SIGUSR1);
        return inner_.turn();
    }
    void keep_iterate(const SolveIterate& iterate) override { inner_.keep_iterate(iterate); }
    void close(bool stopped) override { inner_.close(stopped); }

  private:
    const Comm& comm_;
    SolverCheckpoint& inner_;
    int turns_;
};

SubspaceProblem paper_problem() {
    SubspaceProblem problem = random_subspace_problem(3, 12, 110, 10, 5);
    problem.lambda = 20.0;
    return problem;
}

SolveOptions precise(SolverCheckpoint* checkpoint) {
    return {.gap = 1e-9,
            .max_iterations = 100000,
            .max_seconds = 3600.0,
            .solver = SolverChoice::automatic,
            .checkpoint = checkpoint};
}

constexpr int never = std::numeric_limits<int>::max();

struct Attempt {
    bool checkpointed = false;
    SolveResult result;
    int found = 0;
    std::vector<std::string> warnings;
};

/// One run on the state folder, which ends at the `turns`-th turn.
Attempt attempt(const Comm& comm, const std::string& folder, int turns) {
    const RunState state(comm, folder, LockMode::exclusive, 0.0);
    SolverCheckpointFiles checkpoint(comm, state);
    SignalledCheckpoint signalled(comm, checkpoint, turns);
    Attempt done;
    try {
        done.result = solve_subspace(comm, paper_problem(), precise(&signalled));
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::checkpointed) << error.what();
        done.checkpointed = true;
    }
    done.found = static_cast<int>(all_sum(comm, checkpoint.found_count()));
    done.warnings = checkpoint.warnings();
    return done;
}

TEST(SolverCheckpointFiles, AnIterateContinuesToTheLastBitOnOtherRanks) {
    const Comm world(MPI_COMM_WORLD);
    const Comm alone = world.split(world.rank());
    const SharedFolder folder(world);
    const SolveResult left_alone = solve_subspace(world, paper_problem(), precise(nullptr));
    ASSERT_EQ(left_alone.reason, StopReason::gap_reached);
    ASSERT_GT(left_alone.iterations, 30);
    EXPECT_TRUE(attempt(world, folder.path(), 2).checkpointed);
    if (world.is_root()) {
        const Attempt second = attempt(alone, folder.path(), 1);
        EXPECT_TRUE(second.checkpointed);
        EXPECT_EQ(second.found, 1);
    }
    MPI_Barrier(world.raw());
    EXPECT_TRUE(attempt(world, folder.path(), 2).checkpointed);
    const Attempt last = attempt(world, folder.path(), never);
    EXPECT_FALSE(last.checkpointed);
    expect_same_solution(last.result, left_alone);
    const Attempt again = attempt(world, folder.path(), 1);  // what is finished takes no turn
    EXPECT_EQ(again.found, 1);
    expect_same_solution(again.result, left_alone);
}

TEST(SolverCheckpointFiles, ADamagedIterateIsNamedAndSetAside) {
    const Comm world(MPI_COMM_WORLD);
    const SharedFolder folder(world);
    const SolveResult left_alone = solve_subspace(world, paper_problem(), precise(nullptr));
    EXPECT_TRUE(attempt(world, folder.path(), 3).checkpointed);
    std::string damaged;
    if (world.is_root()) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
            const std::string path = entry.path().string();
            if (entry.path().filename().string().starts_with("iterate-")) damaged = std::max(damaged, path);
        }
        ASSERT_FALSE(damaged.empty());
        std::fstream(damaged, std::ios::in | std::ios::out | std::ios::binary).seekp(2000).put('X');
    }
    MPI_Barrier(world.raw());
    const Attempt last = attempt(world, folder.path(), never);
    expect_same_solution(last.result, left_alone);
    EXPECT_EQ(last.found, 0);
    ASSERT_FALSE(last.warnings.empty());
    if (!world.is_root()) return;
    EXPECT_EQ(last.warnings.front().find(damaged), 0U) << last.warnings.front();
}

}  // namespace
}  // namespace coseg
