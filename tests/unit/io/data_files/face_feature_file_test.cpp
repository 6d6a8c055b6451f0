#include "io/data_files/face_feature_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <limits>
#include <vector>

#include "io/files/hdf5_file.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

/// The bytes that numpy.save writes.
template <class T>
std::string npy(const std::string& header, const std::vector<T>& values, char version = 1) {
    std::string text = header;
    const std::size_t width = version == 1 ? 2 : 4;
    while ((8 + width + text.size() + 1) % 64 != 0) text += ' ';
    text += '\n';
    std::string bytes = std::string("\x93NUMPY") + version + '\0';
    for (std::size_t k = 0; k < width; ++k) bytes += static_cast<char>(text.size() >> (8 * k) & 255);
    bytes += text;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return bytes;
}

std::string header(const std::string& kind, const std::string& order, const std::string& shape) {
    return "{'descr': '" + kind + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

std::string refusal(const std::string& bytes, int faces = 3) {
    return error_of([&] { parse_npy_features(bytes, "a.npy", faces); }).sentence;
}

const std::vector<float> six = {1, 2, 3, 4, 5, 6};

TEST(NpyFeatures, HaveAColumnAFaceInEitherOrderAndPrecision) {
    Eigen::MatrixXf expected(2, 3);
    expected << 1, 3, 5, 2, 4, 6;
    EXPECT_EQ(parse_npy_features(npy(header("<f4", "False", "(3, 2)"), six), "a.npy", 3), expected);
    EXPECT_EQ(parse_npy_features(npy(header("<f4", "False", "(3, 2)"), six, 2), "a.npy", 3), expected);
    EXPECT_EQ(parse_npy_features(npy(header("<f8", "False", "(3, 2)"), std::vector<double>{1, 2, 3, 4, 5, 6}),
                                 "a.npy", 3),
              expected);
    EXPECT_EQ(parse_npy_features(npy(header("<f8", "True", "(3, 2)"), std::vector<double>{1, 3, 5, 2, 4, 6}),
                                 "a.npy", 3),
              expected);
}

TEST(NpyFeatures, OfOneDimensionAreOneNumberAFace) {
    const Eigen::MatrixXf features = parse_npy_features(npy(header("<f4", "False", "(6,)"), six), "a.npy", 6);
    EXPECT_EQ(features, Eigen::Map<const Eigen::MatrixXf>(six.data(), 1, 6));
}

TEST(NpyFeatures, AreRefusedWithASentence) {
    EXPECT_NE(refusal("OFF\n8 6 12\n").find("a.npy: is no NumPy file"), std::string::npos);
    EXPECT_NE(refusal("").find("is no NumPy file"), std::string::npos);
    const std::string good = npy(header("<f4", "False", "(3, 2)"), six);
    EXPECT_NE(refusal(good, 4).find("holds 3 rows, but the mesh file has 4 faces"), std::string::npos);
    EXPECT_NE(refusal(good.substr(0, 40)).find("ends within its header"), std::string::npos);
    EXPECT_NE(
        refusal(good.substr(0, good.size() - 1)).find("23 bytes of values where its header asks for 24"),
        std::string::npos);
    EXPECT_NE(refusal(good + "x").find("25 bytes"), std::string::npos);
    EXPECT_NE(refusal(npy(header("<i8", "False", "(3, 2)"), six)).find("kind '<i8'; save them as float32"),
              std::string::npos);
    EXPECT_NE(refusal(npy(header(">f4", "False", "(3, 2)"), six)).find("little endian"), std::string::npos);
    EXPECT_NE(refusal(npy(header("<f4", "False", "(3, 2, 1)"), six)).find("3 dimensions"), std::string::npos);
    EXPECT_NE(refusal(npy(header("<f4", "False", "(3, 0)"), six)).find("0 numbers a face"),
              std::string::npos);
    EXPECT_NE(refusal(npy(header("<f4", "False", "(3, x)"), six)).find("header that cannot be read"),
              std::string::npos);
    EXPECT_NE(refusal(npy("{}", six)).find("header that cannot be read"), std::string::npos);
    EXPECT_NE(refusal(npy(header("<f4", "False", "(3, 2)"), six, 9)).find("unknown version"),
              std::string::npos);
}

TEST(NpyFeatures, MustBeFinite) {
    std::vector<float> bad = six;
    bad[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(
        refusal(npy(header("<f4", "False", "(3, 2)"), bad)).find("row 2 holds a number that is not finite"),
        std::string::npos);
    const std::vector<double> large = {1, 2, 3, 4, 5, 1e300};
    EXPECT_NE(refusal(npy(header("<f8", "False", "(3, 2)"), large)).find("row 3"), std::string::npos);
}

TEST(FaceFeatureFile, IsFoundByTheNameOfTheMesh) {
    const TemporaryFolder folder;
    const std::string path = folder.file("chair.npy", npy(header("<f4", "False", "(3, 2)"), six));
    EXPECT_EQ(face_feature_path(folder.path(""), "chair"), path);
    EXPECT_EQ(read_face_features(path, 3).rows(), 2);
    EXPECT_NE(
        error_of([&] { face_feature_path(folder.path(""), "table"); }).sentence.find("every mesh needs one"),
        std::string::npos);
    folder.file("chair.h5", "");
    EXPECT_NE(
        error_of([&] { face_feature_path(folder.path(""), "chair"); }).sentence.find("keep one of them"),
        std::string::npos);
}

TEST(FaceFeatureFile, MayBeHdf5) {
    const TemporaryFolder folder;
    Hdf5Writer writer(folder.path("a.h5"), "somebody's features", 1);
    writer.write("features", six, {3, 2});
    writer.write("other", six);
    writer.commit();
    Eigen::MatrixXf expected(2, 3);
    expected << 1, 3, 5, 2, 4, 6;
    EXPECT_EQ(read_face_features(folder.path("a.h5"), 3), expected);
    EXPECT_NE(error_of([&] { read_face_features(folder.path("a.h5"), 2); }).sentence.find("holds 3 rows"),
              std::string::npos);
    Hdf5Writer empty(folder.path("b.h5"), "nothing", 1);
    empty.write("other", six);
    empty.commit();
    EXPECT_NE(
        error_of([&] { read_face_features(folder.path("b.h5"), 3); }).sentence.find("no dataset 'features'"),
        std::string::npos);
}

TEST(FaceFeatureFile, MayBeNoPipe) {
    const TemporaryFolder folder;
    for (const char* name : {"a.npy", "a.h5"}) {
        const std::string path = folder.path(name);
        ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
        const test::Caught caught = error_of([&] { read_face_features(path, 3); });
        EXPECT_EQ(caught.code, ExitCode::input);
        EXPECT_EQ(caught.sentence, path + ": is a pipe, not a file");
    }
}

}  // namespace
}  // namespace coseg
