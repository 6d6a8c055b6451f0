#include "io/data_files/feature_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/files/hdf5_file.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

const Eigen::MatrixXd first = (Eigen::MatrixXd(2, 3) << 1, 2, 3, 4, 5, 6).finished();
const Eigen::MatrixXd second = (Eigen::MatrixXd(1, 3) << 7, 8, 9).finished();

FeatureFile example() {
    FeatureFile file;
    file.names = {"a", "b"};
    file.features = {first, second};
    file.mesh_of = {0, 0, 1};
    file.mesh_names = {"one", "two"};
    file.patch_area = {0.5, 0.5, 1.0};
    file.neighbors = {{0}, {1}, {0.25}};
    file.concavity = {0.75};
    file.overlaps = {{0, 1}, {2, 2}, {0.5, 0.125}};
    return file;
}

TEST(FeatureFile, ReturnsWhatWasWritten) {
    const TemporaryFolder folder;
    write_feature_file(folder.path("f.h5"), example());
    const FeatureFile read = read_feature_file(folder.path("f.h5"));
    EXPECT_EQ(read.names, example().names);
    EXPECT_EQ(read.features, example().features);
    EXPECT_EQ(read.mesh_of, example().mesh_of);
    EXPECT_EQ(read.mesh_names, example().mesh_names);
    EXPECT_EQ(read.patch_area, example().patch_area);
    EXPECT_EQ(read.neighbors.second, example().neighbors.second);
    EXPECT_EQ(read.concavity, example().concavity);
    EXPECT_EQ(read.overlaps.weight, example().overlaps.weight);
}

TEST(FeatureFile, FeaturesAloneAreEnough) {
    const TemporaryFolder folder;
    Hdf5Writer writer(folder.path("f.h5"), "somebody else's", 7);
    writer.write("features/2", std::vector<std::int32_t>{7, 8, 9}, {3, 1});
    writer.write("features/1", std::vector<float>{1, 4, 2, 5, 3, 6}, {3, 2});
    writer.commit();
    const FeatureFile read = read_feature_file(folder.path("f.h5"));
    EXPECT_EQ(read.features, example().features);
    EXPECT_TRUE(read.mesh_of.empty());
}

/// What is said of the example after `change`.
std::string complaint(void (*change)(FeatureFile&)) {
    const TemporaryFolder folder;
    FeatureFile file = example();
    change(file);
    write_feature_file(folder.path("f.h5"), file);
    const auto caught = error_of([&] { read_feature_file(folder.path("f.h5")); });
    EXPECT_EQ(caught.code, ExitCode::input);
    return caught.sentence;
}

TEST(FeatureFile, RefusesPartsThatDoNotFit) {
    const auto has = [](const std::string& text, const std::string& words) {
        return text.find(words) != std::string::npos;
    };
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.mesh_of.pop_back(); }), "'mesh_of' has 2 entries"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.mesh_of[1] = -1; }), "negative"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.mesh_names.pop_back(); }), "'mesh_names' has 1"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.patch_area.push_back(1); }), "'patch_area' has 4"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.neighbors.second[0] = 3; }), "'neighbors', pair 0"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.concavity.clear(); }), "different lengths"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.overlaps.weight[1] = std::nan(""); }), "pair 1"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.overlaps.first.pop_back(); }), "different lengths"));
    EXPECT_TRUE(has(complaint([](FeatureFile& f) { f.mesh_of[2] = 2000000000; }), "2000000000"));
    const auto repeat = [](FeatureFile& f) {
        f.overlaps.first[1] = f.overlaps.first[0];
        f.overlaps.second[1] = f.overlaps.second[0];
    };
    EXPECT_TRUE(has(complaint(repeat), "'overlaps' has the pair of items"));
}

TEST(FeatureFile, RefusesNumbersThatAreNone) {
    for (const double bad : {std::nan(""), HUGE_VAL, -0.5}) {
        const auto complains = [bad](auto member, const std::string& words) {
            const TemporaryFolder folder;
            FeatureFile file = example();
            member(file) = bad;
            write_feature_file(folder.path("f.h5"), file);
            const auto caught = error_of([&] { read_feature_file(folder.path("f.h5")); });
            return caught.code == ExitCode::input && caught.sentence.find(words) != std::string::npos;
        };
        const auto area = [](FeatureFile& f) -> double& { return f.patch_area[1]; };
        const auto length = [](FeatureFile& f) -> double& { return f.neighbors.weight[0]; };
        const auto concavity = [](FeatureFile& f) -> double& { return f.concavity[0]; };
        EXPECT_TRUE(complains(area, "'patch_area'")) << bad;
        EXPECT_TRUE(complains(length, "'neighbors', pair 0")) << bad;
        EXPECT_TRUE(complains(concavity, "'neighbors/concavity'")) << bad;
    }
}

TEST(FeatureFile, RefusesGroupsThatAreNoIntegers) {
    const TemporaryFolder folder;
    Hdf5Writer writer(folder.path("f.h5"), "somebody else's", 7);
    writer.write("features/1", std::vector<float>{1, 4, 2, 5, 3, 6}, {3, 2});
    writer.write("mesh_of", std::vector<double>{0.0, 0.5, 1.0});
    writer.commit();
    const auto caught = error_of([&] { read_feature_file(folder.path("f.h5")); });
    EXPECT_EQ(caught.code, ExitCode::input);
    EXPECT_NE(caught.sentence.find("'mesh_of' holds floating-point numbers"), std::string::npos);
}

TEST(FeatureFile, RefusesFilesWithoutFeatures) {
    const TemporaryFolder folder;
    FeatureFile none;
    write_feature_file(folder.path("none.h5"), none);
    EXPECT_EQ(error_of([&] { read_feature_file(folder.path("none.h5")); }).code, ExitCode::input);
    EXPECT_EQ(error_of([&] { read_feature_file(folder.path("missing.h5")); }).code, ExitCode::input);
}

}  // namespace
}  // namespace coseg
