#include "io/mesh_files/off_format.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/real_meshes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tetrahedron.hpp"

namespace coseg {
namespace {

using test::expect_tetrahedron;

const std::string off_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string off_faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// The points, each with these words behind.
std::string off_points_with(const std::string& words) {
    return "0 0 0 " + words + "\n1 0 0 " + words + "\n0 1 0 " + words + "\n0 0 1 " + words + "\n";
}

std::string with_lines_for_blanks(std::string text) {
    for (char& c : text) c = c == ' ' ? '\n' : c;
    return text;
}

/// The points on one line.
std::string on_one_line(std::string text) {
    for (char& c : text) c = c == '\n' ? ' ' : c;
    return text;
}

TEST(OffFormat, PrefixesInAnyOrderOnOneLineAVertexOrNot) {
    struct Variant {
        std::string prefix;
        std::string words;
    };
    const std::vector<Variant> variants{{"", ""},
                                        {"N", "0 0 1"},
                                        {"C", "255 0 0 255"},
                                        {"C", "1 0.5 0"},
                                        {"ST", "0.5 0.25"},
                                        {"NC", "0 0 1 255 0 0 255"},
                                        {"CN", "0 0 1 0.1 0.2 0.3"},
                                        {"NST", "0 0 1 0.5 0.25"},
                                        {"STN", "0 0 1 0.5 0.25"},
                                        {"CST", "255 0 0 255 0.5 0.25"},
                                        {"STC", "255 0 0 255 0.5 0.25"},
                                        {"NCST", "0 0 1 255 0 0 255 0.5 0.25"},
                                        {"STCN", "0 0 1 9 9 9 0.5 0.25"},
                                        {"4", "1"},
                                        {"ST4", "1 0.5 0.25"},
                                        {"CN4", "1 0 0 1 9 9 9 9"},
                                        {"n", ""},
                                        {"STCN4n", "1 0 0 1 9 9 9 9 0.5 0.25"}};
    for (const Variant& variant : variants) {
        SCOPED_TRACE(variant.prefix + " " + variant.words);
        const bool has_dimension = variant.prefix.find('n') != std::string::npos;
        const std::string head = variant.prefix + "OFF\n" + (has_dimension ? "3\n" : "");
        const std::string vertices = variant.words.empty() ? off_points : off_points_with(variant.words);
        expect_tetrahedron(read_off(head + "4 4 6\n" + vertices + off_faces, "a.off"));
        expect_tetrahedron(read_off(head + "4 4\n" + vertices + off_faces, "a.off"));
        expect_tetrahedron(read_off(head + "4 4\n6\n" + vertices + off_faces, "a.off"));
        expect_tetrahedron(read_off(head + "4 4 6\n" + on_one_line(vertices) + "\n" + off_faces, "a.off"));
        expect_tetrahedron(read_off(head + "4 4 6\n" + with_lines_for_blanks(vertices) + off_faces, "a.off"));
        expect_tetrahedron(read_off(with_lines_for_blanks(head + "4 4 6\n" + vertices + off_faces), "a.off"));
        expect_tetrahedron(read_off(on_one_line(head + "4 4 6\n" + vertices + off_faces), "a.off"));
    }
}

TEST(OffFormat, KeywordAndEdgesMayLack) {
    expect_tetrahedron(read_off("4 4 6\n" + off_points + off_faces, "a.off"));
    expect_tetrahedron(read_off("4 4 " + on_one_line("6 " + off_points + off_faces), "a.off"));
    expect_tetrahedron(read_off("# none\n4 4 # no edges\n\n# here\n" + off_points + off_faces, "a.off"));
    expect_tetrahedron(read_off("OFF\n4 4\n" + with_lines_for_blanks(off_points) + off_faces, "a.off"));
    expect_tetrahedron(read_off("OFF 4 4 6\n" + off_points + off_faces, "a.off"));
    expect_tetrahedron(read_off("off4 4\n" + off_points + off_faces, "a.off"));
}

TEST(OffFormat, WeightsDivideCoordinates) {
    expect_tetrahedron(
        read_off("4OFF\n4 4 6\n0 0 0 1\n2 0 0 2\n0 -3 0 -3\n0 0 0.5 0.5\n" + off_faces, "a.off"));
    const test::Caught at_infinity = test::error_of(
        [] { read_off("4OFF\n4 4 6\n0 0 0 1\n2 0 0 0\n0 1 0 1\n0 0 1 1\n" + off_faces, "a.off"); });
    EXPECT_NE(at_infinity.sentence.find("a.off:4: vertex 1"), std::string::npos) << at_infinity.sentence;
}

TEST(OffFormat, ColoursBehindFacesEndWithTheLine) {
    for (const std::string colour : {"", " 7", " 255 0 0", " 0.1 0.2 0.3", " 3 0 1 2", " 0.1 0.2 0.3 0.4"}) {
        std::string coloured = off_faces;
        for (std::size_t i = coloured.find('\n'); i != std::string::npos;
             i = coloured.find('\n', i + colour.size() + 1))
            coloured.insert(i, colour);
        expect_tetrahedron(read_off("OFF\n4 4 6\n" + off_points + coloured, "a.off"));
        expect_tetrahedron(read_off("OFF\n4 4 6\n" + on_one_line(off_points) + coloured, "a.off"));
    }
}

TEST(OffFormat, WhatFollowsTheFacesIsLeftOutWithOneWarning) {
    for (const std::string rest : {"<!DOCTYPE FilterScript>\n<FilterScript>\n", "3 0 1 2\n3 0 1 2\n", "x"}) {
        const ParsedMesh parsed = read_off("OFF\n4 4 6\n" + off_points + off_faces + rest, "a.off");
        expect_tetrahedron({parsed.mesh, {}});
        ASSERT_EQ(parsed.warnings.size(), 1U);
        EXPECT_TRUE(parsed.warnings[0].starts_with("a.off:11: the file goes on after the 4 faces"))
            << parsed.warnings[0];
    }
    const ParsedMesh free = read_off("OFF\n4 4 6\n" + on_one_line(off_points + off_faces) + "\nend", "a.off");
    expect_tetrahedron({free.mesh, {}});
    EXPECT_EQ(free.warnings.size(), 1U);
}

TEST(OffFormat, VerticesThatNoFaceUsesNeedNoNumbers) {
    const ParsedMesh parsed = read_off(
        "OFF\n7 4 6\nnan nan nan\n0 0 0\n1 0 0\ninf 0 0\n0 1 0\n0 0 1\n1.#QNAN 0 "
        "1e99\n3 1 4 2\n3 1 2 5\n3 1 5 4\n3 2 4 5\n",
        "a.off");
    expect_tetrahedron({parsed.mesh, {}});
    ASSERT_EQ(parsed.warnings.size(), 1U);
    EXPECT_TRUE(parsed.warnings[0].starts_with("a.off: 3 vertices that no face uses have"));
}

TEST(OffFormat, FacesOfNoCornersKeepTheirPlace) {
    const ParsedMesh parsed = read_off("OFF\n4 3 0\n" + off_points + "0\n3 0 1 2\n0 # none\n", "a.off");
    EXPECT_EQ(parsed.mesh.offsets, (std::vector<int>{0, 0, 3, 3}));
    EXPECT_TRUE(parsed.warnings.empty());
}

/// A number too few must not shift the others into another mesh. The number of a face's corners is left out:
/// another one may take its place, and the rest of the line is then a colour.
TEST(OffFormat, NumbersAsFortranAndNumPyWriteThem) {
    expect_tetrahedron(
        read_off("Off\n4 4 6\n0 0 0\n1.0D+00 0.d0 0\n0 +10.D-1 0\n0 0 1d0\n" + off_faces, "a.off"));
    const std::string faces =
        "3.0 0.0 2.0 1.0\n3. 0. 1. 3. 0.5 0.5 0.5\n3e+00 0e+00 3.0e+00 2e+00\n3 1 2 3\n";
    expect_tetrahedron(read_off("OFF\n4 4 6\n" + off_points + faces, "a.off"));
    for (const std::string wrong : {"3 0 2.5 1\n", "3 0 nan 1\n", "3 0 1e300 1\n", "3 0 d0 1\n"})
        EXPECT_THROW(read_off("OFF\n4 1 0\n" + off_points + wrong, "a.off"), Error) << wrong;
}

TEST(OffFormat, CommasAreNamed) {
    for (const std::string point : {"0,5 0,0 1,0\n", "0, 0, 1\n"}) {
        const std::string says = test::error_of([&] {
                                     read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n" + point + "3 0 1 2\n", "a.off");
                                 }).sentence;
        EXPECT_NE(says.find("decimal points"), std::string::npos) << says;
    }
}

TEST(OffFormat, LostNumbersAreNotMadeUpFor) {
    const std::string text = "OFF\n4 4 6\n" + off_points + off_faces;
    for (std::size_t i = 10; i < text.size(); ++i) {
        const bool begins_a_face = text[i - 1] == '\n' && i >= 10 + off_points.size();
        if (text[i] < '0' || text[i] > '9' || begins_a_face) continue;
        const std::string without = text.substr(0, i) + text.substr(i + 1);
        for (const std::string& damaged : {without, with_lines_for_blanks(without), on_one_line(without)}) {
            EXPECT_TRUE(test::error_of([&] { read_off(damaged, "a.off"); }).threw) << damaged;
        }
    }
}

TEST(OffFormat, RefusalsNameTheCause) {
    const auto sentence = [](const std::string& text) {
        return test::error_of([&] { read_off(text, "a.off"); }).sentence;
    };
    EXPECT_NE(sentence("OFF BINARY\n").find("binary OFF"), std::string::npos);
    EXPECT_NE(sentence("NCOFF BINARY\n").find("binary OFF"), std::string::npos);
    EXPECT_NE(sentence("nOFF\n5\n1 1 0\n").find("dimension '5'"), std::string::npos);
    EXPECT_NE(sentence("NXOFF\n1 1 0\n").find("begins with OFF, this one with 'NXOFF'"), std::string::npos);
}

TEST(OffFormat, FacesWithFewerCornersThanTheySayAreNotReadInSilence) {
    const std::string header = "OFF\n4 4 6\n" + off_points;
    // A corner is lost. What it takes from the next line is missed at the end.
    const test::Caught lost =
        test::error_of([&] { parse_mesh(header + "3 0 2\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", "m.off"); });
    EXPECT_NE(lost.sentence.find("m.off:7: face 0 has fewer corners on its line than it says"),
              std::string::npos)
        << lost.sentence;
    // So that nothing is missed, the file has a face more than its header promises: it is read, and named.
    const ParsedMesh odd = parse_mesh(header + "3 0 2\n3 0 1 3\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", "m.off");
    ASSERT_EQ(odd.warnings.size(), 1U);
    EXPECT_NE(odd.warnings[0].find("m.off:7: face 0 has fewer corners on its line"), std::string::npos);
    // A face may be wrapped: with colours behind it, that is said; without, the format is free.
    EXPECT_EQ(
        parse_mesh(header + "3 0 2\n1 9 9 9\n3 0 1 3 9 9 9\n3 0 3 2\n3 1 2 3\n", "m.off").warnings.size(),
        1U);
    const ParsedMesh free = parse_mesh(header + "3 0 2\n1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", "m.off");
    expect_tetrahedron(free);
}

TEST(OffFormat, DownloadedMeshWithParametersBehindItsFaces) {
    const std::string path = test::measured_file("as_downloaded/psb_cup_21.off");
    if (path.empty()) GTEST_SKIP() << "no downloaded meshes; set COSEG_DATA";
    const ParsedMesh parsed = parse_mesh(test::content_of(path), path);
    EXPECT_EQ(parsed.mesh.vertex_count(), 15198);
    EXPECT_EQ(parsed.mesh.face_count(), 30396);
    EXPECT_EQ(parsed.warnings.size(), 1U);
}

}  // namespace
}  // namespace coseg
