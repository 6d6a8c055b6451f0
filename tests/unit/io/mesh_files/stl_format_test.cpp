#include "io/mesh_files/stl_format.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/files/byte_cursor.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/tetrahedron.hpp"

namespace coseg {
namespace {

using test::expect_tetrahedron;

using Triangle = std::array<Eigen::Vector3d, 3>;

std::vector<Triangle> tetrahedron(const Eigen::Vector3d& origin, double size) {
    const Eigen::Vector3d x = origin + Eigen::Vector3d(size, 0, 0);
    const Eigen::Vector3d y = origin + Eigen::Vector3d(0, size, 0);
    const Eigen::Vector3d z = origin + Eigen::Vector3d(0, 0, size);
    return {{origin, y, x}, {origin, x, z}, {origin, z, y}, {x, y, z}};
}

std::string binary(const std::string& header, std::uint32_t count, const std::vector<Triangle>& triangles) {
    std::string bytes = header;
    bytes.resize(80, ' ');
    append_little_endian(bytes, count);
    for (const Triangle& triangle : triangles) {
        for (int k = 0; k < 3; ++k) append_little_endian(bytes, 0.0F);
        for (const Eigen::Vector3d& corner : triangle) {
            for (const double value : corner) append_little_endian(bytes, static_cast<float>(value));
        }
        append_little_endian(bytes, std::uint16_t{0});
    }
    return bytes;
}

const std::string stl_text =
    "solid part\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 "
    "0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "endsolid part\n";

std::string replaced(std::string where, const std::string& what, const std::string& by) {
    for (std::size_t i = where.find(what); i != std::string::npos; i = where.find(what, i + by.size()))
        where.replace(i, what.size(), by);
    return where;
}

TEST(StlFormat, TextInEveryDialect) {
    std::string capitals = stl_text;
    for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const std::string apart = replaced(replaced(stl_text, "endloop", "end loop"), "endfacet", "end facet");
    for (const std::string& dialect :
         {stl_text, capitals, replaced(stl_text, "\n", " "),
          replaced(replaced(stl_text, " part", ""), " ", "\n"), replaced(stl_text, "\n", "\r\n"), apart,
          replaced(apart, "endsolid", "end solid"), replaced(stl_text, "endsolid part", "end"),
          replaced(stl_text, "endsolid part", "endsolidpart"),
          replaced(stl_text, "solid part\n", "solidpart\n"), replaced(stl_text, "outer loop", "outerloop"),
          replaced(stl_text, "solid part", "solid a facet of it"),
          replaced(stl_text, "endfacet\nfacet normal 1", "endfacet\nendsolid\nsolid b\nfacet normal 1")})
        expect_tetrahedron(read_stl(dialect, "a.stl"));
}

TEST(StlFormat, TextWithColoursCommentsOrWithoutWhatNobodyReads) {
    const std::string open_solid = "endfacet\nsolid b#2\nfacet normal -1 0 0\n";
    for (const std::string& text :
         {replaced(stl_text, "facet normal 0", "color 0.5 0.5 0.5\nfacet normal 0"),
          replaced(stl_text, "facet normal 1 1 1", "facet"),
          replaced(stl_text, "endfacet\nfacet normal -1 0 0\n", open_solid),
          "# made by a program\n" + replaced(stl_text, "endloop", "endloop # of 3")})
        expect_tetrahedron(read_stl(text, "a.stl"));
    const std::string says = test::error_of([] {
                                 read_stl(replaced(stl_text, "vertex 0 0 1", "vertex 0,0 0,0 1,0"), "a.stl");
                             }).sentence;
    EXPECT_NE(says.find("decimal points"), std::string::npos) << says;
}

TEST(StlFormat, TextThatEndsEarlyOrLate) {
    const ParsedMesh early = read_stl(stl_text.substr(0, stl_text.find("endsolid")), "a.stl");
    expect_tetrahedron({early.mesh, {}});
    ASSERT_EQ(early.warnings.size(), 1U);
    EXPECT_NE(early.warnings[0].find("without 'endsolid'"), std::string::npos);
    const ParsedMesh late = read_stl(stl_text + "<html>\nmore\n", "a.stl");
    expect_tetrahedron({late.mesh, {}});
    ASSERT_EQ(late.warnings.size(), 1U);
    EXPECT_TRUE(late.warnings[0].starts_with("a.stl:31: the file goes on after 'endsolid'"))
        << late.warnings[0];
    const test::Caught inside =
        test::error_of([] { read_stl(stl_text.substr(0, stl_text.find("endfacet")), "a.stl"); });
    EXPECT_NE(inside.sentence.find("ends inside facet 0"), std::string::npos) << inside.sentence;
    const test::Caught bare = test::error_of([] { read_stl(stl_text.substr(11), "a.stl"); });
    EXPECT_NE(bare.sentence.find("begins with 'facet' and not with 'solid'"), std::string::npos)
        << bare.sentence;
}

TEST(StlFormat, BinaryCountsAndBytesBehind) {
    const std::vector<Triangle> triangles = tetrahedron(Eigen::Vector3d::Zero(), 1.0);
    for (const std::string header : {"binary", "solid part", "facet"}) {
        expect_tetrahedron(read_stl(binary(header, 4, triangles), "a.stl"));
        for (const std::uint32_t no_count : {0U, 0xFFFFFFFFU}) {
            const ParsedMesh piped = read_stl(binary(header, no_count, triangles), "a.stl");
            expect_tetrahedron({piped.mesh, {}});
            ASSERT_EQ(piped.warnings.size(), 1U);
            EXPECT_NE(piped.warnings[0].find("there are 4"), std::string::npos) << piped.warnings[0];
        }
        for (const std::string behind : {"x", "two"}) {
            const ParsedMesh longer = read_stl(binary(header, 4, triangles) + behind, "a.stl");
            expect_tetrahedron({longer.mesh, {}});
            EXPECT_EQ(longer.warnings.size(), 1U);
        }
        const test::Caught cut = test::error_of([&] { read_stl(binary(header, 5, triangles), "a.stl"); });
        EXPECT_NE(cut.sentence.find("4 of the 5 facets"), std::string::npos) << cut.sentence;
    }
}

TEST(StlFormat, TextKeepsAllDigits) {
    const ParsedMesh far =
        read_stl(replaced(replaced(stl_text, " 0", " 4500000.0"), " 1", " 4500000.1"), "a.stl");
    ASSERT_EQ(far.mesh.vertex_count(), 4);
    EXPECT_EQ(far.mesh.vertices[1], Eigen::Vector3d(4500000.0, 4500000.1, 4500000.0));
    EXPECT_TRUE(far.warnings.empty());
}

TEST(StlFormat, BinaryThatLostDigitsIsWarnedOf) {
    const Eigen::Vector3d map(5e5, 4.5e6, 100);
    const auto warnings = [](const Eigen::Vector3d& origin, double size) {
        return read_stl(binary("", 4, tetrahedron(origin, size)), "a.stl").warnings;
    };
    const std::vector<std::string> lost = warnings(map, 10.0);
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_NE(lost[0].find("coordinates up to 4.50001e+06 in single precision have steps of 0.5"),
              std::string::npos)
        << lost[0];
    EXPECT_TRUE(warnings(map, 1000.0).empty());
    EXPECT_TRUE(warnings({0, 0, 0}, 1e-6).empty());
    EXPECT_TRUE(warnings({1000, 1000, 0}, 1.0).empty());
}

TEST(StlFormat, TextWithAZeroByteInTheNameOfASolid) {
    for (const std::string& name : {std::string("a\0b", 3), std::string("a\0\0\0", 4)})
        expect_tetrahedron(read_stl(replaced(stl_text, "solid part\n", "solid " + name + "\n"), "a.stl"));
    // A binary file that is cut short stays one, whatever its header begins with.
    const std::string cut = binary("solid part\n", 5, tetrahedron(Eigen::Vector3d::Zero(), 1.0));
    const std::string says = test::error_of([&] { read_stl(cut, "a.stl"); }).sentence;
    EXPECT_NE(says.find("4 of the 5 facets"), std::string::npos) << says;
}

}  // namespace
}  // namespace coseg
