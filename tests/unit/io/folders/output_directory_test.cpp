#include "io/folders/output_directory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <set>

#include "io/data_files/label_file.hpp"
#include "io/files/atomic_file.hpp"
#include "io/folders/state_folder.hpp"
#include "io/folders/state_lock.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::TemporaryFolder;

/// Every file and folder below, relative.
std::set<std::string> tree(const std::string& folder) {
    std::set<std::string> paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        paths.insert(fs::relative(entry.path(), folder).string());
    return paths;
}

TEST(OutputDirectory, AppearsWholeAtCommit) {
    const TemporaryFolder folder;
    OutputDirectory output(folder.path("out/"), false);
    EXPECT_EQ(output.path(), fs::canonical(folder.path()).string() + "/out");
    write_labels(output.staging() + "/labels/a.seg", {1, 2});
    EXPECT_FALSE(fs::exists(folder.path("out")));
    output.commit();
    EXPECT_EQ(tree(folder.path()),
              (std::set<std::string>{"out", "out/labels", "out/labels/a.seg", "out/patches", "out/ply"}));
}

TEST(OutputDirectory, MayHaveTheLongestName) {
    const TemporaryFolder folder;
    const std::string name(255, 'n');
    {
        OutputDirectory output(folder.path(name), false);
        write_labels(output.staging() + "/labels/a.seg", {1});
        output.commit();
    }
    EXPECT_EQ(tree(folder.path()), (std::set<std::string>{name, name + "/labels", name + "/labels/a.seg",
                                                          name + "/patches", name + "/ply"}));
    const auto caught = error_of([&] { const OutputDirectory longer(folder.path("n" + name), false); });
    EXPECT_NE(caught.sentence.find("File name too long"), std::string::npos) << caught.sentence;
}

TEST(OutputDirectory, WithoutCommitNothingStays) {
    const TemporaryFolder folder;
    {
        const OutputDirectory output(folder.path("new/parents/out"), false);
        write_labels(output.staging() + "/labels/a.seg", {1});
        EXPECT_TRUE(fs::exists(output.staging() + "/ply"));
    }
    EXPECT_TRUE(tree(folder.path()).empty());
}

TEST(OutputDirectory, NothingStaysWhereNoFileCanBeOpened) {
    const TemporaryFolder folder;
    std::optional<OutputDirectory> output(std::in_place, folder.path("out"), false);
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    rlimit none = limit;
    none.rlim_cur = 0;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    output.reset();
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
    EXPECT_EQ(tree(folder.path()), std::set<std::string>());
}

TEST(OutputDirectory, ACurrentFolderThatIsGoneIsRefused) {
    const fs::path before = fs::current_path();
    {
        const TemporaryFolder folder;
        fs::current_path(folder.path());
    }
    const std::string results = error_of([] { OutputDirectory("out", false); }).sentence;
    const std::string state = error_of([] { StateFolder::open("state"); }).sentence;
    fs::current_path(before);
    EXPECT_NE(results.find("out: the output folder's path cannot be followed"), std::string::npos) << results;
    EXPECT_NE(state.find("state: the state folder's path cannot be followed"), std::string::npos) << state;
}

TEST(OutputDirectory, AnEmptyFolderIsTaken) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path("out"));
    OutputDirectory output(folder.path("out"), false);
    output.commit();
    EXPECT_EQ(tree(folder.path()), (std::set<std::string>{"out", "out/labels", "out/patches", "out/ply"}));
}

TEST(OutputDirectory, NamesAreTriedBeforehand) {
    const TemporaryFolder folder;
    const OutputDirectory output(folder.path("out"), false);
    const std::string longest(251, 'x');  // 255 bytes with ".seg"
    output.try_names({"a", longest, "caf\xe9", "new\nline", "b"}, 1000);
    write_labels(output.staging() + "/labels/" + longest + ".seg", {1, 2});
    EXPECT_EQ(read_labels(output.staging() + "/labels/" + longest + ".seg", 2), (std::vector<int>{1, 2}));
    fs::remove(output.staging() + "/labels/" + longest + ".seg");
    EXPECT_EQ(tree(output.staging()), (std::set<std::string>{"labels", "patches", "ply"}));
    const test::Caught too_long = error_of([&] { output.try_names({"a", longest + "y"}, 1000); });
    EXPECT_EQ(too_long.code, ExitCode::output);
    EXPECT_NE(too_long.sentence.find("rename the mesh"), std::string::npos) << too_long.sentence;
    const test::Caught too_much = error_of([&] { output.try_names({"a"}, std::uintmax_t{1} << 60U); });
    EXPECT_EQ(too_much.code, ExitCode::output);
    EXPECT_NE(too_much.sentence.find("MiB are free"), std::string::npos) << too_much.sentence;
}

TEST(OutputDirectory, WhatIsInTheWayIsRefusedAtOnce) {
    const TemporaryFolder folder;
    const auto refused = [&] {
        return error_of([&] { const OutputDirectory output(folder.path("out"), true); }).sentence;
    };
    for (const std::string in_the_way : {"out/report.json", "out/labels/a.seg", "out/ply/b.ply"}) {
        fs::create_directories(folder.path(in_the_way));
        EXPECT_EQ(refused(), fs::canonical(folder.path(in_the_way)).string() +
                                 ": is a folder where a result is to be put; move it or name another");
        fs::remove_all(folder.path("out"));
    }
    fs::create_directory(folder.path("out"));
    for (const std::string in_the_way : {"patches", "sheets", "levels"}) {
        folder.file("out/" + in_the_way, "");
        EXPECT_NE(refused().find(in_the_way + ": is a file where a folder"), std::string::npos);
        fs::remove(folder.path("out/" + in_the_way));
    }
    fs::create_directories(folder.path("out/labels/mine"));
    EXPECT_EQ(refused(), "");
    EXPECT_EQ(tree(folder.path()), (std::set<std::string>{"out", "out/labels", "out/labels/mine"}));
}

TEST(OutputDirectory, FilesAndFullFoldersAreRefused) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path("full"));
    folder.file("full/mine.txt", "keep");
    folder.file("file", "keep");
    const std::set<std::string> before = tree(folder.path());
    const test::Caught full = error_of([&] { OutputDirectory(folder.path("full"), false); });
    EXPECT_EQ(full.code, ExitCode::output);
    EXPECT_NE(full.sentence.find(folder.path("full")), std::string::npos);
    EXPECT_NE(full.sentence.find("--force"), std::string::npos);
    for (const bool force : {false, true}) {
        EXPECT_EQ(error_of([&] { OutputDirectory(folder.path("file"), force); }).code, ExitCode::output);
        EXPECT_EQ(error_of([&] { OutputDirectory(folder.path("file/below"), force); }).code,
                  ExitCode::output);
        EXPECT_EQ(error_of([&] { OutputDirectory("", force); }).code, ExitCode::output);
        EXPECT_EQ(error_of([&] { OutputDirectory("/", force); }).code, ExitCode::output);
    }
    EXPECT_EQ(tree(folder.path()), before);
}

TEST(OutputDirectory, ForceReplacesResultsAndNothingElse) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path("out/labels"));
    fs::create_directories(folder.path("out/mine"));
    folder.file("out/labels/a.seg", "old");
    folder.file("out/labels/gone.seg", "old");
    folder.file("out/labels/notes.txt", "keep");
    folder.file("out/mine/b.seg", "keep");
    folder.file("out/report.json", "{\"format\": \"coseg report 1\"}");
    folder.file("out/other.json", "keep");
    OutputDirectory output(folder.path("out"), true);
    write_labels(output.staging() + "/labels/a.seg", {7});
    write_labels(output.staging() + "/report.json", {8});
    EXPECT_EQ(test::content_of(folder.path("out/labels/a.seg")), "old");
    output.commit();
    EXPECT_EQ(tree(folder.path("out")),
              (std::set<std::string>{"labels", "labels/a.seg", "labels/notes.txt", "mine", "mine/b.seg",
                                     "other.json", "patches", "ply", "report.json"}));
    EXPECT_EQ(test::content_of(folder.path("out/labels/a.seg")), "7\n");
    EXPECT_EQ(test::content_of(folder.path("out/report.json")), "8\n");
    EXPECT_EQ(tree(folder.path()).count(fs::path(output.staging()).filename().string()), 0U);
}

TEST(OutputDirectory, ForceTakesFilesOfAnEarlierRunByTheirWholeNames) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path("out"));
    const std::set<std::string> of_run = {"affinity.png", "contact_sheet.png", "contact_sheet_truth.png",
                                          "features.h5",  "model.h5",          "names.txt",
                                          "report.html"};
    const std::set<std::string> of_user = {"contact_sheet.pptx", "labels.txt", "model.h5.backup",
                                           "profile.txt.old", "report.html.mine"};
    for (const auto* names : {&of_run, &of_user}) {
        for (const std::string& name : *names) folder.file("out/" + name, "earlier");
    }
    folder.file("out/report.json", "{\"format\": \"coseg report 1\"}");
    OutputDirectory(folder.path("out"), true).commit();
    for (const std::string& name : of_run) EXPECT_FALSE(fs::exists(folder.path("out/" + name))) << name;
    for (const std::string& name : of_user) EXPECT_TRUE(fs::exists(folder.path("out/" + name))) << name;
}

TEST(OutputDirectory, ForceKeepsWhatAPersonWroteOfAnEarlierRun) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path("out"));
    const auto run = [&](const std::string& name, const std::string& text) {
        OutputDirectory output(folder.path("out"), true);
        if (!text.empty()) write_file(output.staging() + "/" + name, text);
        output.commit();
    };
    const auto content = [&](const std::string& name) {
        return test::content_of(folder.path("out/" + name));
    };
    folder.file("out/report.json", "{\"format\": \"coseg report 1\"}");
    folder.file("out/corrections.json", "first");
    folder.file("out/names.txt", "seat");
    run("corrections.json", "");
    EXPECT_EQ(content("corrections.json"), "first");
    EXPECT_EQ(content("names_1.txt"), "seat");  // of parts that are no longer there
    EXPECT_FALSE(fs::exists(folder.path("out/names.txt")));
    run("corrections.json", "first");
    EXPECT_FALSE(fs::exists(folder.path("out/corrections_1.json")));
    run("corrections.json", "second");
    run("corrections.json", "third");
    EXPECT_EQ(content("corrections.json"), "third");
    EXPECT_EQ(content("corrections_1.json"), "first");
    EXPECT_EQ(content("corrections_2.json"), "second");
}

TEST(OutputDirectory, ForceRemovesNothingWhereNoRunWas) {
    const TemporaryFolder folder;
    const std::vector<std::string> of_user{"labels/mine.seg", "ply/scan.ply", "levels/3/x.seg",
                                           "features.h5",     "names.txt",    "profile.txt"};
    fs::create_directories(folder.path("out/labels"));
    fs::create_directories(folder.path("out/ply"));
    fs::create_directories(folder.path("out/levels/3"));
    for (const std::string& name : of_user) folder.file("out/" + name, "mine");
    folder.file("out/report.json", "{}");
    OutputDirectory(folder.path("out"), true).commit();
    for (const std::string& name : of_user)
        EXPECT_EQ(test::content_of(folder.path("out/" + name)), "mine") << name;
}

TEST(OutputDirectory, ForceLeavesARunOnWhichASessionIsOpen) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path("out"));
    {
        const StateLock session(folder.path("out/") + session_lock_name, LockMode::exclusive);
        const std::string refused = error_of([&] { OutputDirectory(folder.path("out"), true); }).sentence;
        EXPECT_NE(refused.find("coseg edit works on the run in it"), std::string::npos) << refused;
    }
    OutputDirectory(folder.path("out"), true).commit();
}

TEST(OutputDirectory, ForceWithoutCommitLeavesTheOldResults) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path("out/labels"));
    folder.file("out/labels/a.seg", "old");
    const std::set<std::string> before = tree(folder.path());
    {
        const OutputDirectory output(folder.path("out"), true);
        write_labels(output.staging() + "/labels/a.seg", {7});
    }
    EXPECT_EQ(tree(folder.path()), before);
    EXPECT_EQ(test::content_of(folder.path("out/labels/a.seg")), "old");
}

TEST(OutputDirectory, FilledMeanwhileIsNotOverwritten) {
    const TemporaryFolder folder;
    {
        OutputDirectory output(folder.path("out"), false);
        fs::create_directory(folder.path("out"));
        folder.file("out/theirs.txt", "keep");
        EXPECT_EQ(error_of([&] { output.commit(); }).code, ExitCode::output);
    }
    EXPECT_EQ(tree(folder.path()), (std::set<std::string>{"out", "out/theirs.txt"}));
}

TEST(OutputDirectory, AFolderThatExistsIsFilledFromWithin) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path("out/.partial-1/labels"));  // of a killed run
    OutputDirectory output(folder.path("out"), false);
    EXPECT_EQ(fs::path(output.staging()).parent_path(), output.path());
    write_labels(output.staging() + "/labels/a.seg", {1});
    output.commit();
    EXPECT_EQ(tree(folder.path("out")), (std::set<std::string>{".partial-1", ".partial-1/labels", "labels",
                                                               "labels/a.seg", "patches", "ply"}));
}

/// The number of a process that has ended.
pid_t ended_process() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return child;
}

TEST(OutputDirectory, AProcessThatNobodyHasSeenToIsDead) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    siginfo_t ended;
    ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);  // ended, and still there
    std::string left;
    {
        const OutputDirectory output(folder.path("out"), false);
        left = output.staging();
        left.resize(left.size() - std::to_string(::getpid()).size());
    }
    left += std::to_string(child);
    fs::create_directory(left);
    const OutputDirectory output(folder.path("out"), false);
    EXPECT_FALSE(fs::exists(left));
    ::waitpid(child, nullptr, 0);
}

TEST(OutputDirectory, WhatKilledRunsLeftGoesWithTheNext) {
    const TemporaryFolder folder;
    for (const bool inside : {false, true}) {
        const std::string out = folder.path(inside ? "there" : "new");
        if (inside) fs::create_directory(out);
        std::string mark;  // all but the process number of a partial folder's name
        {
            const OutputDirectory output(out, false);
            const std::string& staging = output.staging();
            mark = staging.substr(0, staging.size() - std::to_string(::getpid()).size());
        }
        const std::string dead = mark + std::to_string(ended_process());
        const std::string alive = mark + std::to_string(::getppid());
        const std::string other = mark + "1x";  // of a machine whose name begins like ours
        for (const std::string& left : {dead, alive, other}) fs::create_directories(left + "/labels");
        write_labels(dead + "/labels/a.seg", {1});
        const OutputDirectory output(out, false);
        EXPECT_FALSE(fs::exists(dead));
        EXPECT_TRUE(fs::exists(alive));
        EXPECT_TRUE(fs::exists(other));
    }
}

TEST(OutputDirectory, AbandonRemovesWhatIsPartialOnly) {
    const TemporaryFolder folder;
    OutputDirectory given_up(folder.path("x/y"), false);
    given_up.abandon();
    EXPECT_TRUE(tree(folder.path()).empty());
    OutputDirectory kept(folder.path("z"), false);
    kept.commit();
    kept.abandon();
    EXPECT_TRUE(fs::exists(folder.path("z/ply")));
}

TEST(OutputDirectory, ALinkToNothingIsRefused) {
    const TemporaryFolder folder;
    fs::create_directory_symlink(folder.path("nowhere"), folder.path("link"));
    EXPECT_EQ(error_of([&] { OutputDirectory(folder.path("link"), true); }).code, ExitCode::output);
    EXPECT_EQ(tree(folder.path()), std::set<std::string>{"link"});
}

TEST(OutputDirectory, SymbolicLinkToAFolderIsFollowed) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path("real"));
    fs::create_directory_symlink(folder.path("real"), folder.path("link"));
    OutputDirectory output(folder.path("link"), false);
    output.commit();
    EXPECT_TRUE(fs::is_symlink(folder.path("link")));
    EXPECT_TRUE(fs::exists(folder.path("real/labels")));
}

}  // namespace
}  // namespace coseg
