// The generate command: the same bytes whatever the number of ranks, and errors that all ranks see.

#include <gtest/gtest.h>

#include <mpi.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "mpi_drivers/options/command.hpp"
#include "src/base/error.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;

/// Runs `coseg generate ARGUMENTS` on the communicator's ranks.
void run_generate(const Comm& comm, const std::vector<std::string>& arguments) {
    CLI::App app("coseg");
    const Command command = add_generate_command(app);
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    reversed.emplace_back("generate");
    app.parse(reversed);
    command.run({comm, {}});
}

std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        files[entry.path().lexically_relative(folder).string()] = {std::istreambuf_iterator<char>(file), {}};
    }
    return files;
}

class GenerateCommand : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("coseg_generate_test_" + std::to_string(comm_.size()));
        if (comm_.is_root()) fs::remove_all(folder_);
        MPI_Barrier(comm_.raw());
    }
    void TearDown() override {
        MPI_Barrier(comm_.raw());
        if (comm_.is_root()) fs::remove_all(folder_);
    }
    [[nodiscard]] std::string out(const std::string& name) const { return (folder_ / name).string(); }

    Comm comm_{MPI_COMM_WORLD};
    fs::path folder_;
};

TEST_F(GenerateCommand, SameBytesOnAnyNumberOfRanks) {
    const std::vector<std::string> what{"cup", "--count", "4", "--seed", "9", "--faces", "2000", "--out"};
    std::vector<std::string> together = what, alone = what;
    together.push_back(out("together"));
    run_generate(comm_, together);
    if (!comm_.is_root()) return;
    alone.push_back(out("alone"));
    const Comm self(MPI_COMM_SELF);
    run_generate(self, alone);
    const auto files = contents(out("together"));
    EXPECT_EQ(files, contents(out("alone")));
    EXPECT_EQ(files.size(), 9U);
    EXPECT_EQ(files.at("truth/labels.txt"), "0 body\n1 handle\n");
    EXPECT_EQ(files.at("meshes/cup_0003.off").substr(0, 4), "OFF\n");
    EXPECT_EQ(files.count("truth/cup_0000.seg"), 1U);
}

TEST_F(GenerateCommand, ANonEmptyFolderNeedsForceAndOldShapesGo) {
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"human", "--faces", "2000", "--out", out("shapes")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run_generate(comm_, arguments);
    };
    run({"--count", "2"});
    if (comm_.is_root()) std::ofstream(fs::path(out("shapes")) / "meshes" / "mine.off") << "kept";
    MPI_Barrier(comm_.raw());
    try {
        run({"--count", "1"});
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::output);
        EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos);
    }
    run({"--count", "1", "--force"});
    EXPECT_EQ(contents(out("shapes")).size(), 4U);
    EXPECT_TRUE(fs::exists(fs::path(out("shapes")) / "meshes" / "mine.off"));
}

TEST_F(GenerateCommand, UsageErrorsAreAgreed) {
    const std::vector<std::vector<std::string>> wrong{
        {"chiar", "--out", out("x")}, {"chair"}, {"--out", out("x")}};
    for (const auto& arguments : wrong) {
        try {
            run_generate(comm_, arguments);
            FAIL() << "no throw";
        } catch (const AgreedError& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
        }
    }
    EXPECT_THROW(run_generate(comm_, {"cup", "--count", "0", "--out", out("x")}), CLI::ValidationError);
    EXPECT_THROW(run_generate(comm_, {"cup", "--faces", "100", "--out", out("x")}), CLI::ValidationError);
    EXPECT_FALSE(fs::exists(out("x")));
    EXPECT_NO_THROW(run_generate(comm_, {"list"}));
    EXPECT_NO_THROW(run_generate(comm_, {"--list"}));
}

TEST_F(GenerateCommand, AFolderThatCannotBeMadeIsAnOutputErrorOnAllRanks) {
    if (comm_.is_root()) {
        fs::create_directories(folder_);
        std::ofstream(out("file")) << "not a folder";
    }
    MPI_Barrier(comm_.raw());
    for (const std::string& bad : {out("file"), out("file") + "/below"}) {
        try {
            run_generate(comm_, {"cup", "--count", "1", "--out", bad});
            FAIL() << "no throw";
        } catch (const AgreedError& error) {
            EXPECT_EQ(error.code(), ExitCode::output) << error.what();
        }
    }
}

}  // namespace
}  // namespace coseg
