#include "io/folders/state_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "io/files/atomic_file.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::TemporaryFolder;

TEST(StateFolder, IsMadeOnceAndFoundAgain) {
    const TemporaryFolder folder;
    const StateFolder made = StateFolder::make(folder.path("new/state/"));
    EXPECT_EQ(made.path(), fs::canonical(folder.path()).string() + "/new/state");
    EXPECT_EQ(StateFolder::make(folder.path("new/state")).path(), made.path());
    EXPECT_EQ(StateFolder::open(folder.path("new/state")).path(), made.path());
    EXPECT_TRUE(made.files().empty());
    EXPECT_TRUE(made.leftovers().empty());
}

TEST(StateFolder, DoesNotTakeOtherFolders) {
    const TemporaryFolder folder;
    const std::string file = folder.file("thesis.tex", "years of work");
    const auto caught = error_of([&] { StateFolder::make(folder.path()); });
    EXPECT_EQ(caught.code, ExitCode::output);
    EXPECT_NE(caught.sentence.find("is no state folder"), std::string::npos);
    EXPECT_EQ(error_of([&] { StateFolder::open(folder.path()); }).code, ExitCode::input);
    EXPECT_EQ(error_of([&] { StateFolder::make(file); }).code, ExitCode::output);
    EXPECT_EQ(error_of([&] { StateFolder::make(""); }).code, ExitCode::usage);
}

TEST(StateFolder, ItsMarkMayBeNoPipe) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo(folder.path("coseg-state").c_str(), 0600), 0);
    EXPECT_EQ(error_of([&] { StateFolder::open(folder.path()); }).code, ExitCode::input);
}

TEST(StateFolder, SpreadsMeshesOverSubfolders) {
    const StateFolder folder = StateFolder::at("/state");
    EXPECT_EQ(folder.mesh_file({0xab00000000000001ULL, 2}),
              "/state/meshes/ab/ab000000000000010000000000000002.h5");
    EXPECT_EQ(folder.solver_folder({1, 2}), "/state/solver/00000000000000010000000000000002");
}

TEST(StateFolder, ListsFilesAndLeftoversApart) {
    const TemporaryFolder place;
    const StateFolder folder = StateFolder::make(place.path("state"));
    const std::string mesh = folder.mesh_file({1, 2});
    const std::string damaged = folder.mesh_file({3, 4});
    for (const std::string& file : {mesh, damaged}) {
        make_parent_folders(file);
        write_file(file, "0123456789");
    }
    write_file(mesh + ".partial-77", "half");
    const std::string aside = folder.set_aside(damaged);
    EXPECT_FALSE(fs::exists(damaged));
    EXPECT_EQ(aside, folder.path() + "/damaged/" + fs::path(damaged).filename().string());
    ASSERT_EQ(folder.files().size(), 1U);
    EXPECT_EQ(folder.files().front().path, mesh);
    EXPECT_EQ(folder.files().front().bytes, 10U);
    ASSERT_EQ(folder.leftovers().size(), 2U);
    EXPECT_EQ(folder.leftovers()[0].path, aside);
    EXPECT_EQ(folder.leftovers()[1].path, mesh + ".partial-77");
}

TEST(StateFolder, KnowsHowLongAFileHasNotBeenUsed) {
    const TemporaryFolder place;
    const StateFolder folder = StateFolder::make(place.path("state"));
    const std::string file = folder.mesh_file({1, 2});
    make_parent_folders(file);
    write_file(file, "x");
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(48));
    EXPECT_GE(folder.files().front().age_seconds, 48 * 3600 - 1);
    mark_as_used(file);
    EXPECT_LT(folder.files().front().age_seconds, 3600);
}

}  // namespace
}  // namespace coseg
