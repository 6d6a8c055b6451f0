// Runs the distributed tests, or those of one source (--tests-of), on every rank. A failure on any rank fails
// the run, and every rank's failures are printed.

#include <gtest/gtest.h>
#include <mpi.h>
#include <slepceps.h>

#include <string>

#include "tests/support/tests_of_file.hpp"

namespace {

/// Prints only what fails, with the rank, so that four ranks do not print everything four times.
class FailurePrinter : public testing::EmptyTestEventListener {
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (!result.failed()) return;
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        std::string text = "[rank " + std::to_string(rank) + "] ";
        text += result.file_name() != nullptr ? result.file_name() : "";
        text += ":" + std::to_string(result.line_number()) + "\n" + result.message() + "\n";
        std::fputs(text.c_str(), stderr);
    }
};

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (!choose_tests_of_file(argc, argv)) return 1;
    if (SlepcInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    if (rank != 0) {
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new FailurePrinter);
    }
    const int mine = RUN_ALL_TESTS();
    int any = 0;
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    SlepcFinalize();
    return any;
}
