#include "io/data_files/alignment_file.hpp"

#include <gtest/gtest.h>

#include "io/files/atomic_file.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

AlignmentFile turned_shapes() {
    AlignedShape a;
    a.name = "chair_1";
    a.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    a.scale = 1.0 / 3.0;
    a.translation = {0.1, -2.0, 1e-17};
    a.agreement = 0.4;
    a.residual = 0.25;
    a.found = true;
    AlignedShape b;
    b.name = "not \xff UTF-8";
    b.rotation.diagonal() << 1, 1, -1;
    b.reflected = true;
    return {true, "because", 0.25, 0.1, 0.3, {a, b}};
}

TEST(AlignmentFile, KeepsEveryNumberAndName) {
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/alignment.json";
    const AlignmentFile given = turned_shapes();
    write_file(path, alignment_text(given));
    const AlignmentFile read = read_alignment(path);
    EXPECT_TRUE(read.aligned);
    EXPECT_EQ(read.reason, "because");
    EXPECT_EQ(read.standing_share, 0.25);
    EXPECT_EQ(read.agreement_before, 0.1);
    EXPECT_EQ(read.agreement_after, 0.3);
    ASSERT_EQ(read.shapes.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(read.shapes[k].name, given.shapes[k].name);
        EXPECT_EQ(read.shapes[k].rotation, given.shapes[k].rotation);
        EXPECT_EQ(read.shapes[k].scale, given.shapes[k].scale);
        EXPECT_EQ(read.shapes[k].translation, given.shapes[k].translation);
        EXPECT_EQ(read.shapes[k].agreement, given.shapes[k].agreement);
        EXPECT_EQ(read.shapes[k].residual, given.shapes[k].residual);
        EXPECT_EQ(read.shapes[k].reflected, given.shapes[k].reflected);
        EXPECT_EQ(read.shapes[k].found, given.shapes[k].found);
    }
}

TEST(AlignmentFile, RefusesWhatItHasNotWritten) {
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/alignment.json";
    AlignmentFile bent = turned_shapes();
    bent.shapes[0].rotation(0, 0) = 0.5;
    write_file(path, alignment_text(bent));
    EXPECT_NE(error_of([&] { read_alignment(path); }).sentence.find("the rotation of 'chair_1' is none"),
              std::string::npos);
    write_file(path, "{\"format\": \"coseg report 1\"}");
    EXPECT_NE(error_of([&] { read_alignment(path); }).sentence.find("is not an alignment"),
              std::string::npos);
    write_file(path, "[1,");
    EXPECT_NE(error_of([&] { read_alignment(path); }).sentence.find("cannot be read as an alignment"),
              std::string::npos);
}

}  // namespace
}  // namespace coseg
