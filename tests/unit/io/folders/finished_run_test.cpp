#include "io/folders/finished_run.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "io/files/content_hash.hpp"
#include "io/reports/report.hpp"
#include "src/base/error.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

const std::string part_labels = "0\n1\n1\n";
const std::string patch_labels = "0\n1\n2\n";

std::string text_of_report() {
    Report report;
    report.partition.part_area = {0.25, 0.75};
    ReportMesh mesh;
    mesh.facts.name = "cup_1";
    mesh.facts.path = "meshes/cup_1.off";
    mesh.part_area = {0.5, 0.5};
    mesh.labels_xxh3 = hash_bytes(part_labels).hex();
    mesh.patches_xxh3 = hash_bytes(patch_labels).hex();
    report.meshes.push_back(mesh);
    return report_text(
        {}, {{"parts", "2"}, {"seed", "7"}, {"patches", "10"}, {"geodesic-samples", "50"}, {"state", "s"}},
        report);
}

std::string replaced(std::string text, const std::string& old, const std::string& fresh) {
    return text.replace(text.find(old), old.size(), fresh);
}

std::string finished_folder(const TemporaryFolder& folder, const std::string& report) {
    std::filesystem::create_directories(folder.path("labels"));
    std::filesystem::create_directories(folder.path("patches"));
    folder.file("labels/cup_1.seg", part_labels);
    folder.file("patches/cup_1.seg", patch_labels);
    folder.file("report.json", report);
    return folder.path();
}

TEST(FinishedRun, SaysWhatTheRunWas) {
    const TemporaryFolder folder;
    const FinishedRun run = read_finished_run(finished_folder(folder, text_of_report()));
    EXPECT_FALSE(run.is_report_changed);
    EXPECT_EQ(run.parts, 2);
    EXPECT_EQ(run.seed, 7U);
    EXPECT_EQ(run.patches, 10);
    EXPECT_EQ(run.geodesic_samples, 50);
    EXPECT_EQ(run.state, "s");
    EXPECT_EQ(run.part_area, (std::vector<double>{0.25, 0.75}));
    ASSERT_EQ(run.shapes.size(), 1U);
    EXPECT_EQ(run.shapes[0].name, "cup_1");
    EXPECT_EQ(run.shapes[0].path, "meshes/cup_1.off");
    EXPECT_TRUE(files_changed_since(folder.path()).empty());
}

TEST(FinishedRun, NoticesWhatWasEdited) {
    const TemporaryFolder folder;
    finished_folder(folder, replaced(text_of_report(), "0.25", "0.26"));
    folder.file("patches/cup_1.seg", "0\n1\n1\n");
    const FinishedRun run = read_finished_run(folder.path());
    EXPECT_TRUE(run.is_report_changed);
    EXPECT_EQ(run.part_area, (std::vector<double>{0.26, 0.75}));
    EXPECT_EQ(files_changed_since(folder.path()),
              (std::vector<std::string>{folder.path("report.json"), folder.path("patches/cup_1.seg")}));
}

TEST(FinishedRun, RefusesNumbersThatCannotBe) {
    for (const auto& [old, fresh] : std::vector<std::pair<std::string, std::string>>{
             {"\"parts\": 2", "\"parts\": 3"},
             {"\"parts\": 2", "\"parts\": 4294967298"},
             {"\"parts\": 2", "\"parts\": 2.5"},
             {"\"parts\": 2", "\"parts\": -2"},
             {"\"patches\": 10", "\"patches\": 0"},
             {"\"geodesic-samples\": 50", "\"geodesic-samples\": 500000000"},
             {"0.25", "-0.25"},
             {"0.75", "7.5"},
             {"\"cup_1\"", "\"../cup_1\""},
             {"\"cup_1\"", "\"\""},
             {"\"cup_1\"", "\"cup\\u0000_1\""},
             {"\"cup_1\"", "5"}}) {
        const TemporaryFolder folder;
        finished_folder(folder, replaced(text_of_report(), old, fresh));
        const test::Caught caught = error_of([&] { read_finished_run(folder.path()); });
        EXPECT_EQ(caught.code, ExitCode::input) << fresh;
        EXPECT_NE(caught.sentence.find("report.json: "), std::string::npos) << caught.sentence;
    }
}

TEST(FinishedRun, PipesInItsFolderAreRefused) {
    const TemporaryFolder folder;
    const std::string path = folder.path("report.json");
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const test::Caught caught = error_of([&] { read_finished_run(folder.path()); });
    EXPECT_EQ(caught.code, ExitCode::input);
    EXPECT_EQ(caught.sentence, path + ": is a pipe, not a file");
}

}  // namespace
}  // namespace coseg
