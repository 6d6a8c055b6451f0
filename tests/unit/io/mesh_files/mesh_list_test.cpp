#include "io/mesh_files/mesh_list.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "io/mesh_files/mesh_reader.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

std::vector<std::string> names(const std::vector<MeshEntry>& entries) {
    std::vector<std::string> result;
    for (const MeshEntry& entry : entries) result.push_back(entry.name);
    return result;
}

TEST(MeshList, FilesFoldersAndListsSortedByName) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path("set/deeper.off/inside"));
    folder.file("set/b.off", "12345");
    folder.file("set/a.OBJ", "");
    folder.file("set/c d.Ply", "1");
    folder.file("set/notes.txt", "");
    folder.file("set/.hidden.off", "");
    folder.file("set/deeper.off/inside/x.off", "");
    folder.file("z.stl", "");
    folder.file("10.off", "");
    folder.file("9.off", "");
    const std::string list =
        folder.file("list.txt", "# the rest\r\n\r\n  9.off  \r\n" + folder.path("z.stl") + " # last\n");
    const std::vector<MeshEntry> entries =
        expand_mesh_list({folder.path("set"), folder.path("10.off"), "@" + list});
    EXPECT_EQ(names(entries), (std::vector<std::string>{"10", "9", "a", "b", "c d", "deeper", "z"}));
    EXPECT_EQ(entries[3].bytes, 5U);
    EXPECT_EQ(entries[3].path, folder.path("set/b.off"));
    EXPECT_TRUE(std::filesystem::exists(entries[1].path));
}

TEST(MeshList, WhatIsNoFileInAFolderIsListedAndSaysSoWhenRead) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path("set/folder.off"));
    folder.file("set/good.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    std::filesystem::create_symlink("nowhere.off", folder.path("set/dangling.off"));
    std::filesystem::create_symlink("loop.off", folder.path("set/loop.off"));
    std::filesystem::create_symlink("good.off", folder.path("set/link.off"));
    ASSERT_EQ(::mkfifo(folder.path("set/pipe.off").c_str(), 0600), 0);
    std::filesystem::create_symlink("nowhere.ply", folder.path("set/good.ply"));  // gives way to good.off
    const std::vector<MeshEntry> entries = expand_mesh_list({folder.path("set")});
    EXPECT_EQ(names(entries),
              (std::vector<std::string>{"dangling", "folder", "good", "link", "loop", "pipe"}));
    const auto sentence = [](const MeshEntry& entry) {
        const test::Caught caught = error_of([&] { read_mesh(entry.path); });
        return caught.threw ? caught.sentence.substr(entry.path.size()) : "";
    };
    EXPECT_EQ(sentence(entries[0]), ": is a link to nowhere.off, which is not there");
    EXPECT_EQ(sentence(entries[1]), ": is a folder, not a file");
    EXPECT_EQ(sentence(entries[2]), "");
    EXPECT_EQ(sentence(entries[3]), "");
    EXPECT_EQ(sentence(entries[4]), ": is a link that leads back to itself");
    EXPECT_EQ(sentence(entries[5]), ": is a pipe, not a file");
}

TEST(MeshList, ListsMayBeInOtherEncodingsAndComeFromAPipe) {
    const TemporaryFolder folder;
    folder.file("a.off", "");
    folder.file("b\xc3\xa4.off", "");
    const std::string utf8 = "# meshes\r\na.off\r\nb\xc3\xa4.off\r\n";
    folder.file("marked", "\xEF\xBB\xBF" + utf8);
    std::string utf16 = "\xff\xfe";
    for (const char c : std::string("a.off\r\nb\xe4.off\r\n")) utf16.append({c, '\0'});
    folder.file("utf16", utf16);
    const std::vector<std::string> both{"a", "b\xc3\xa4"};
    EXPECT_EQ(names(expand_mesh_list({"@" + folder.path("marked")})), both);
    EXPECT_EQ(names(expand_mesh_list({"@" + folder.path("utf16")})), both);
    ASSERT_EQ(::mkfifo(folder.path("pipe").c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(folder.path("pipe")) << utf8; });
    EXPECT_EQ(names(expand_mesh_list({"@" + folder.path("pipe")})), both);
    writer.join();
}

TEST(MeshList, ListLinesMayNameFoldersAndFilesWithSigns) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("set"));
    folder.file("set/a.off", "");
    folder.file("b#1.off", "");
    const std::string list = folder.file("list", "set\nb#1.off");
    EXPECT_EQ(names(expand_mesh_list({"@" + list})), (std::vector<std::string>{"a", "b#1"}));
}

TEST(MeshList, ListIsRelativeToTheCurrentFolderToo) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("lists"));
    folder.file("here.off", "");
    const std::string list = folder.file("lists/l.txt", "here.off\n");
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const std::vector<MeshEntry> entries = expand_mesh_list({"@" + list});
    std::filesystem::current_path(before);
    EXPECT_EQ(names(entries), std::vector<std::string>{"here"});
}

void expect_error(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
    const test::Caught caught = error_of([&] { expand_mesh_list(arguments); });
    EXPECT_EQ(caught.code, ExitCode::input);
    for (const std::string& word : words)
        EXPECT_NE(caught.sentence.find(word), std::string::npos) << caught.sentence << " lacks " << word;
}

TEST(MeshList, ErrorsNameThePath) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("empty"));
    std::filesystem::create_directory(folder.path("set"));
    folder.file("set/a.off", "");
    folder.file("a.obj", "");
    folder.file("mesh.txt", "");
    expect_error({}, {"no mesh is given"});
    expect_error({folder.path("none")}, {folder.path("none"), "no such file"});
    expect_error({folder.path("empty")}, {folder.path("empty"), "has no"});
    expect_error({folder.path("mesh.txt")}, {folder.path("mesh.txt"), "@"});
    expect_error({folder.path("set"), folder.path("a.obj")},
                 {"'a'", folder.path("set/a.off"), folder.path("a.obj")});
    expect_error({folder.path("a.obj"), folder.path("a.obj")}, {"'a'"});
    expect_error({"@" + folder.path("none.txt")}, {folder.path("none.txt")});
    expect_error({"@" + folder.file("l0", std::string("set/a.off\0a.obj\0", 16))},
                 {folder.path("l0"), "zero bytes", "one path a line"});
    expect_error({"@" + folder.file("l1", "# nothing\n\n")}, {folder.path("l1"), "names no meshes"});
    expect_error({"@" + folder.file("l2", "\nset/a.off\nlost.off\n")},
                 {folder.path("l2") + ":3:", "lost.off"});
    expect_error({"@" + folder.file("l3", "mesh.txt\n")}, {folder.path("l3") + ":1:", "mesh.txt"});
    expect_error({"@" + folder.path("set")}, {folder.path("set")});
    expect_error({"@"}, {"@"});
    expect_error({""}, {"no such file"});
}

TEST(MeshList, TwentyThousandPathsAreQuick) {
    const TemporaryFolder folder;
    folder.file("m.off", "");
    std::string list;
    for (int i = 0; i < 20000; ++i) {
        const std::string name = "m" + std::to_string(i) + ".off";
        std::filesystem::create_hard_link(folder.path("m.off"), folder.path(name));
        list += name + "\n";
    }
    folder.file("list", list);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(expand_mesh_list({"@" + folder.path("list")}).size(), 20000U);
    EXPECT_EQ(expand_mesh_list({folder.path()}).size(), 20001U);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace coseg
