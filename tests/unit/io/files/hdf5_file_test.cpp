#include "io/files/hdf5_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>

#include "io/files/content_hash.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::error_of;
using test::TemporaryFolder;

constexpr const char* format = "coseg test";

std::string write_example(const TemporaryFolder& folder, const std::string& name = "example.h5") {
    Hdf5Writer file(folder.path(name), format, 3);
    file.write("group/floats", std::vector<float>{0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F}, {3, 2}, true);
    file.write("group/deep/doubles", std::vector<double>{1e-300, -0.0, 1.0 / 3.0});
    file.write("integers", std::vector<std::int32_t>{1, -2, 3});
    file.write("longs", std::vector<std::int64_t>{1LL << 60, -1});
    file.write("hashes", std::vector<std::uint64_t>{~0ULL});
    file.write("flags", std::vector<std::int8_t>{0, 1});
    file.write("none", std::vector<double>{});
    file.write_matrix("matrix", (Eigen::MatrixXd(2, 3) << 1, 2, 3, 4, 5, 6).finished());
    file.write_texts("texts", {"one", "", "zwölf"});
    file.write_texts("no_texts", {});
    file.attribute("count", std::int64_t{7});
    file.attribute("ratio", 0.25);
    file.attribute("words", std::string("two words"));
    file.commit();
    return folder.path(name);
}

TEST(Hdf5File, ReturnsWhatWasWritten) {
    const TemporaryFolder folder;
    const Hdf5Reader file(write_example(folder), format, 3);
    EXPECT_EQ(file.read<float>("group/floats"), (std::vector<float>{0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F}));
    EXPECT_EQ(file.shape("group/floats"), (Hdf5Shape{3, 2}));
    EXPECT_EQ(file.read<double>("group/deep/doubles"), (std::vector<double>{1e-300, -0.0, 1.0 / 3.0}));
    EXPECT_EQ(file.read<std::int32_t>("integers"), (std::vector<std::int32_t>{1, -2, 3}));
    EXPECT_EQ(file.read<double>("integers"), (std::vector<double>{1, -2, 3}));
    EXPECT_EQ(file.read<std::int64_t>("longs"), (std::vector<std::int64_t>{1LL << 60, -1}));
    EXPECT_EQ(file.read<std::uint64_t>("hashes"), std::vector<std::uint64_t>{~0ULL});
    EXPECT_EQ(file.read<std::int8_t>("flags"), (std::vector<std::int8_t>{0, 1}));
    EXPECT_TRUE(file.read<double>("none").empty());
    EXPECT_EQ(file.read_matrix("matrix"), (Eigen::MatrixXd(2, 3) << 1, 2, 3, 4, 5, 6).finished());
    EXPECT_EQ(file.shape("matrix"), (Hdf5Shape{3, 2}));
    EXPECT_EQ(file.read_texts("texts"), (std::vector<std::string>{"one", "", "zwölf"}));
    EXPECT_TRUE(file.read_texts("no_texts").empty());
    EXPECT_EQ(file.integer("count"), 7);
    EXPECT_EQ(file.number("ratio"), 0.25);
    EXPECT_EQ(file.text("words"), "two words");
    EXPECT_TRUE(file.has("group/deep/doubles"));
    EXPECT_FALSE(file.has("group/shallow/doubles"));
    EXPECT_EQ(file.names("group"), (std::vector<std::string>{"deep", "floats"}));
}

TEST(Hdf5File, TheSameContentGivesTheSameBytes) {
    const TemporaryFolder folder;
    const std::string first = write_example(folder);
    const std::string before = content_of(first);
    write_example(folder);
    EXPECT_EQ(content_of(first), before);
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().filename(), "example.h5");
}

TEST(Hdf5File, FindsEveryKindOfDamage) {
    const TemporaryFolder folder;
    const std::string path = write_example(folder);
    const std::string whole = content_of(path);
    verify_checksum(path);
    for (std::size_t at = 512; at < whole.size(); at += 97) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << at % 8));
        const std::string damaged = folder.file("damaged.h5", bytes);
        const auto caught = error_of([&] { const Hdf5Reader file(damaged, format, 3); });
        ASSERT_TRUE(caught.threw) << "byte " << at;
        EXPECT_EQ(caught.sentence,
                  damaged + ": is damaged: its bytes do not have the checksum of its first line");
    }
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, std::size_t{512}, whole.size() - 1}) {
        const std::string cut = folder.file("cut.h5", whole.substr(0, length));
        EXPECT_NE(error_of([&] { verify_checksum(cut); }).sentence.find("is damaged"), std::string::npos)
            << length;
    }
    const std::string longer = folder.file("longer.h5", whole + "x");
    EXPECT_NE(error_of([&] { verify_checksum(longer); }).sentence.find("is damaged"), std::string::npos);
    std::string bytes = whole;
    bytes[3] = 'X';
    const std::string other = folder.file("other.h5", bytes);
    EXPECT_NE(error_of([&] { verify_checksum(other); }).sentence.find("first line"), std::string::npos);
}

TEST(Hdf5File, RefusesOtherFormatsAndVersions) {
    const TemporaryFolder folder;
    const std::string path = write_example(folder);
    const auto version = error_of([&] { const Hdf5Reader file(path, format, 4); });
    EXPECT_EQ(version.code, ExitCode::input);
    EXPECT_EQ(version.sentence,
              path + ": has version 3 of the format 'coseg test'; this program reads version 4");
    EXPECT_EQ(error_of([&] { const Hdf5Reader file(path, "coseg other", 3); }).sentence,
              path + ": holds 'coseg test', not 'coseg other'");
}

TEST(Hdf5File, NamesFileAndDatasetInErrors) {
    const TemporaryFolder folder;
    const std::string path = write_example(folder);
    const Hdf5Reader file(path, format, 3);
    EXPECT_EQ(error_of([&] { (void)file.read<double>("absent"); }).sentence,
              path + ": has no dataset 'absent'");
    EXPECT_EQ(error_of([&] { (void)file.read<double>("texts"); }).sentence,
              path + ": the dataset 'texts' does not hold numbers");
    EXPECT_EQ(error_of([&] { (void)file.read_texts("matrix"); }).sentence,
              path + ": the dataset 'matrix' does not hold texts");
    EXPECT_EQ(error_of([&] { (void)file.read_matrix("integers"); }).sentence,
              path + ": the dataset 'integers' has 1 axes, not 2");
    EXPECT_EQ(error_of([&] { (void)file.integer("absent"); }).sentence, path + ": has no attribute 'absent'");
    EXPECT_NE(
        error_of([&] { const Hdf5Reader gone(folder.path("gone.h5"), format, 3); }).sentence.find("No such"),
        std::string::npos);
}

TEST(Hdf5File, ReadsFilesOfOthersWithoutOurFirstLine) {
    const TemporaryFolder folder;
    std::string bytes = content_of(write_example(folder));
    std::fill(bytes.begin(), bytes.begin() + 512, '\0');
    const std::string path = folder.file("foreign.h5", bytes);
    EXPECT_EQ(Hdf5Reader(path, Hdf5Origin::foreign).integer("count"), 7);
    EXPECT_TRUE(error_of([&] { const Hdf5Reader file(path, Hdf5Origin::ours); }).threw);
    const std::string text = folder.file("text.h5", "no HDF5 at all");
    EXPECT_EQ(error_of([&] { const Hdf5Reader file(text, Hdf5Origin::foreign); }).sentence,
              text + ": is not an HDF5 file");
}

/// A file of another program with one dataset of doubles, chunked where `chunk` is not 0, and never written.
std::string foreign_file(const TemporaryFolder& folder, const std::vector<hsize_t>& shape, hsize_t chunk,
                         const std::string& raw = "") {
    const std::string path = folder.path("foreign.h5");
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const std::vector<hsize_t> chunks(shape.size(), chunk);
    if (chunk > 0) H5Pset_chunk(creation, static_cast<int>(shape.size()), chunks.data());
    if (!raw.empty()) H5Pset_external(creation, raw.c_str(), 0, 16);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t set = H5Dcreate2(file, "a", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    const hid_t values = H5Acreate2(file, "many", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(set, 0);
    H5Aclose(values);
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(creation);
    H5Lcreate_external((path + "2").c_str(), "a", file, "b", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    return path;
}

void expect_refused(const std::string& path, const std::string& name, const std::string& words) {
    const Hdf5Reader file(path, Hdf5Origin::foreign);
    const test::Caught caught = error_of([&] { static_cast<void>(file.read<double>(name)); });
    EXPECT_EQ(caught.code, ExitCode::input);
    EXPECT_NE(caught.sentence.find(words), std::string::npos) << caught.sentence;
}

TEST(Hdf5File, BelievesShapesNoFurtherThanTheFileIsLong) {
    const TemporaryFolder folder;
    const hsize_t large = hsize_t{1} << 33;
    // 2^66 values, which as a number of 64 bits are 4.
    expect_refused(foreign_file(folder, {large, large}, 16), "a", "more values than the file can hold");
    expect_refused(foreign_file(folder, {1 << 20}, 16), "a", "more values than the file can hold");
    const Hdf5Reader file(foreign_file(folder, {0, large}, 16), Hdf5Origin::foreign);
    EXPECT_TRUE(file.read<double>("a").empty());
}

TEST(Hdf5File, ReadsNoOtherFile) {
    const TemporaryFolder folder;
    folder.file("raw", "sixteen bytes, ok");
    expect_refused(foreign_file(folder, {2}, 0, folder.path("raw")), "a", "lies in another file");
    const std::string path = foreign_file(folder, {2}, 0);
    fs::copy(path, path + "2");
    expect_refused(path, "b", "lies in another file");
    EXPECT_EQ(Hdf5Reader(path, Hdf5Origin::foreign).read<double>("a"), (std::vector<double>{0, 0}));
}

/// Three texts of five bytes each, as another program writes them.
std::string file_of_filled_texts(const TemporaryFolder& folder, const std::string& bytes, H5T_str_t filled) {
    const std::string path = folder.path("texts.h5");
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 5);
    H5Tset_strpad(type, filled);
    const hsize_t count = bytes.size() / 5;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t set = H5Dcreate2(file, "a", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), 0);
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
    H5Fclose(file);
    return path;
}

TEST(Hdf5File, ReadsTextsThatAreFilledUpToOneLength) {
    const TemporaryFolder folder;
    const std::vector<std::string> expected = {"one", "", "seven"};
    const std::string zeros("one\0\0\0\0\0\0\0seven", 15);
    EXPECT_EQ(
        Hdf5Reader(file_of_filled_texts(folder, zeros, H5T_STR_NULLPAD), Hdf5Origin::foreign).read_texts("a"),
        expected);
    EXPECT_EQ(
        Hdf5Reader(file_of_filled_texts(folder, "one       seven", H5T_STR_SPACEPAD), Hdf5Origin::foreign)
            .read_texts("a"),
        expected);
}

TEST(Hdf5File, AnAttributeOfManyValuesIsNoNumber) {
    const TemporaryFolder folder;
    const Hdf5Reader file(foreign_file(folder, {1000}, 0), Hdf5Origin::foreign);
    for (const test::Caught& caught : {error_of([&] { static_cast<void>(file.number("many")); }),
                                       error_of([&] { static_cast<void>(file.integer("many")); }),
                                       error_of([&] { static_cast<void>(file.text("many")); })})
        EXPECT_NE(caught.sentence.find("is not a single value"), std::string::npos) << caught.sentence;
}

TEST(Hdf5File, SaysThatItCannotBeWritten) {
    const TemporaryFolder folder;
    Hdf5Writer file(folder.path("absent/file.h5"), format, 1);
    file.write("values", std::vector<double>{1.0});
    const auto caught = error_of([&] { file.commit(); });
    EXPECT_EQ(caught.code, ExitCode::output);
    EXPECT_NE(caught.sentence.find("absent/file.h5"), std::string::npos);
}

TEST(ContentHash, IsThatOfTheReferenceProgram) {
    // printf '' | xxhsum -H2 and printf abc | xxhsum -H2
    EXPECT_EQ(hash_bytes("").hex(), "99aa06d3014798d86001c324468d497f");
    EXPECT_EQ(hash_bytes("abc").hex(), "06b05ab6733a618578af5f94892f3950");
}

TEST(ContentHash, PiecesGiveTheWholeAndValuesKeepTheirBounds) {
    ContentHasher pieces;
    pieces.add_bytes("ab", 2);
    pieces.add_bytes("c", 1);
    EXPECT_EQ(pieces.result(), hash_bytes("abc"));
    ContentHasher one, other;
    one.add("ab");
    one.add("c");
    other.add("a");
    other.add("bc");
    EXPECT_NE(one.result(), other.result());
}

}  // namespace
}  // namespace coseg
