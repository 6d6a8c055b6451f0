#include "io/mesh_files/gltf_format.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "io/mesh_files/mesh_format.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/gltf_files.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::little_endian;
using test::tetrahedron_glb;
using test::tetrahedron_json;
using test::with;

const std::vector<Eigen::Vector3d> unit_tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The positions of all corners of all faces, in their order.
std::vector<Eigen::Vector3d> corners_of(const PolygonMesh& mesh) {
    std::vector<Eigen::Vector3d> corners;
    for (const int corner : mesh.corners) corners.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
    return corners;
}

std::vector<Eigen::Vector3d> tetrahedron_corners(const std::vector<int>& numbers) {
    std::vector<Eigen::Vector3d> corners;
    for (const int number : numbers) corners.push_back(unit_tetrahedron[static_cast<std::size_t>(number)]);
    return corners;
}

const std::vector<Eigen::Vector3d> all_corners = tetrahedron_corners({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});

PolygonMesh corpus_mesh(const std::string& name) {
    const std::filesystem::path root =
        std::filesystem::path(__FILE__).parent_path().parent_path().parent_path().parent_path();
    return read_mesh((root / "corpus/mesh_files/read" / name).string());
}

std::string refusal_of(const std::string& bytes) {
    const test::Caught caught = test::error_of([&] { parse_mesh(bytes, "a.glb"); });
    EXPECT_EQ(caught.code, ExitCode::input);
    return caught.sentence;
}

TEST(GltfFormat, TheSameTrianglesWhateverTheIndicesAre) {
    for (const char* name :
         {"indices_of_one_byte.glb", "indices_of_two_bytes.glb", "indices_of_four_bytes.glb",
          "no_indices.glb", "interleaved.glb", "quantized.glb", "base64.gltf", "no_scene.glb",
          "points_too.glb", "nan_unused.glb", "binary_in_text_suffix.gltf"}) {
        SCOPED_TRACE(name);
        const PolygonMesh mesh = corpus_mesh(name);
        EXPECT_EQ(corners_of(mesh), all_corners);
        EXPECT_EQ(mesh.vertex_count(), 4);  // also where every corner has a vertex of its own
    }
}

TEST(GltfFormat, StripsAndFansKeepTheirDirection) {
    // The strip 0 1 2 3 3 1: the third triangle and the fourth repeat a vertex.
    EXPECT_EQ(corners_of(corpus_mesh("strip.glb")), tetrahedron_corners({0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(corners_of(corpus_mesh("fan.glb")), tetrahedron_corners({1, 2, 0, 2, 3, 0}));
}

TEST(GltfFormat, SparseElementsReplaceOthers) {
    const PolygonMesh mesh = corpus_mesh("sparse.glb");
    EXPECT_EQ(mesh.vertices[3], Eigen::Vector3d(0, 0, 4));
}

TEST(GltfFormat, NodesStandInTheirPlaces) {
    const PolygonMesh mesh = corpus_mesh("nested_nodes.glb");
    ASSERT_EQ(mesh.face_count(), 8);
    const std::vector<Eigen::Vector3d> corners = corners_of(mesh);
    const Eigen::Vector3d shift(1, 2, 3);
    // (0, 0, 0.6, 0.8) is a turn about z with cosine 0.28 and sine 0.96.
    Eigen::Matrix3d turn;
    turn << 0.28, -0.96, 0, 0.96, 0.28, 0, 0, 0, 1;
    for (std::size_t k = 0; k < 12; ++k) {
        EXPECT_EQ(corners[k], Eigen::Vector3d(2 * all_corners[k] + shift));
        EXPECT_LT((corners[12 + k] - (turn * all_corners[k] + shift)).norm(), 1e-15);
    }
}

TEST(GltfFormat, MatricesAreByColumnsAndMirrorsTurnFaces) {
    // x, y, z go to z, x, y: no mirror.
    EXPECT_EQ(corners_of(corpus_mesh("matrix.glb"))[2], Eigen::Vector3d(5, 6, 8));
    const PolygonMesh mirrored =
        parse_mesh(tetrahedron_glb(with(tetrahedron_json, R"({"mesh":0})", R"({"mesh":0,"scale":[-1,1,1]})")),
                   "a.glb")
            .mesh;
    EXPECT_EQ(corners_of(mirrored)[1], Eigen::Vector3d(-1, 0, 0));
    EXPECT_EQ(corners_of(mirrored)[2], Eigen::Vector3d(0, 1, 0));
}

TEST(GltfFormat, FacesAreInTheOrderOfNodesThenPrimitives) {
    const std::string two_primitives =
        with(tetrahedron_json, R"({"attributes":{"POSITION":0},"indices":1})",
             R"({"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"mode":6})");
    const std::string nodes = with(
        with(
            two_primitives, R"([{"mesh":0}])",
            R"([{"children":[2,1]},{"mesh":0,"translation":[10,0,0]},{"children":[3],"translation":[20,0,0]},{"mesh":0}])"),
        R"([{"nodes":[0]}])", R"([{"nodes":[]},{"nodes":[0]}])");
    const PolygonMesh mesh =
        parse_mesh(tetrahedron_glb(with(nodes, R"("scene":0)", R"("scene":1)")), "a.glb").mesh;
    ASSERT_EQ(mesh.face_count(), 12);
    const std::vector<Eigen::Vector3d> corners = corners_of(mesh);
    EXPECT_EQ(corners[0], Eigen::Vector3d(20, 0, 0));
    EXPECT_EQ(corners[12], Eigen::Vector3d(21, 0, 0));  // the fan begins with vertex 1
    EXPECT_EQ(corners[18], Eigen::Vector3d(10, 0, 0));
    EXPECT_EQ(corners[30], Eigen::Vector3d(11, 0, 0));
    EXPECT_EQ(mesh.vertex_count(), 8);  // primitives of one place share their vertices
}

TEST(GltfFormat, SkinsStandWhereTheirVerticesStand) {
    const std::string skinned =
        with(with(tetrahedron_json, R"({"mesh":0})", R"({"mesh":0,"skin":0,"translation":[9,9,9]})"),
             R"("scene":0,)", R"("scene":0,"skins":[{"joints":[0]}],)");
    EXPECT_EQ(corners_of(parse_mesh(tetrahedron_glb(skinned), "a.glb").mesh), all_corners);
}

TEST(GltfFormat, BuffersBesideTheFile) {
    const test::TemporaryFolder folder;
    folder.file("my data.bin", test::tetrahedron_bytes());
    const auto json = [](const std::string& uri) {
        return with(tetrahedron_json, R"({"byteLength":72})", R"({"byteLength":72,"uri":")" + uri + "\"}");
    };
    const std::string path = folder.file("a.gltf", json("my%20data.bin"));
    EXPECT_EQ(corners_of(read_mesh(path)), all_corners);
    const std::string before = mesh_file_bytes(path);
    folder.file("my data.bin", with(test::tetrahedron_bytes(), std::string("\0\0\x80\x3f", 4),
                                    std::string("\0\0\0\x40", 4)));
    EXPECT_NE(mesh_file_bytes(path), before);  // what is kept of a mesh goes by these bytes
    EXPECT_EQ(read_mesh(path).vertices[2], Eigen::Vector3d(2, 0, 0));
    for (const char* uri :
         {"gone.bin", "../a.gltf", "/etc/passwd", "http://host/x.bin", "sub/../../x.bin", "%2e%2e/x.bin"}) {
        SCOPED_TRACE(uri);
        const std::string sentence =
            test::error_of([&] { read_mesh(folder.file("b.gltf", json(uri))); }).sentence;
        EXPECT_TRUE(sentence.starts_with(folder.path("b.gltf") + ": names ")) << sentence;
    }
    const std::string sentence = test::error_of([&] {
                                     folder.file("short.bin", "12345678");
                                     read_mesh(folder.file("c.gltf", json("short.bin")));
                                 }).sentence;
    EXPECT_NE(sentence.find("buffers[0] should have 72 bytes, but there are 8"), std::string::npos)
        << sentence;
}

TEST(GltfFormat, SentencesNameThePlace) {
    const auto said = [](const std::string& from, const std::string& to) {
        return refusal_of(tetrahedron_glb(with(tetrahedron_json, from, to)));
    };
    EXPECT_NE(said(R"("count":4)", R"("count":5)").find("accessors[0] has 5 elements"), std::string::npos);
    EXPECT_NE(said(R"("count":4)", R"("count":3)")
                  .find("meshes[0].primitives[0] refers to vertex 3 with its index 5"),
              std::string::npos);
    EXPECT_NE(said(R"({"mesh":0})", R"({"mesh":4})").find("nodes[0].mesh is 4, but there are 1 meshes"),
              std::string::npos);
    EXPECT_NE(said(R"("indices":1)", R"("indices":"one")")
                  .find("meshes[0].primitives[0].indices is no whole number"),
              std::string::npos);
    EXPECT_NE(said(R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"])")
                  .find("compressed with KHR_draco"),
              std::string::npos);
    EXPECT_NE(refusal_of(tetrahedron_glb().substr(0, 500)).find("500 of the"), std::string::npos);
    const std::string whole = tetrahedron_glb();
    const ParsedMesh longer = parse_mesh(whole + "more", "a.glb");
    ASSERT_EQ(longer.warnings.size(), 1U);
    EXPECT_EQ(longer.warnings.front(), "a.glb: 4 bytes behind the end that the header gives are left out");
}

TEST(GltfFormat, PartsOfAPlainMeshAreNodesWithNames) {
    const test::TemporaryFolder folder;
    const PolygonMesh mesh =
        test::polygons_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.75}},
                          {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {2, 3}});
    const std::string path = folder.path("a.glb");
    write_glb(path, mesh, {{{"part", {1, 0, 0, 0, 0, 1}}}, {}, {"roof", "floor"}});
    const PolygonMesh back = read_mesh(path);
    ASSERT_EQ(back.face_count(), 6);  // four of the roof, two of the floor
    EXPECT_EQ(corners_of(back)[0], mesh.vertices[0]);
    EXPECT_EQ(corners_of(back)[12], mesh.vertices[3]);
    const std::string bytes = test::content_of(path);
    EXPECT_LT(bytes.find(R"({"name":"roof","extras":{"part":0},"mesh":0})"),
              bytes.find(R"({"name":"floor","extras":{"part":1},"mesh":1})"));
    EXPECT_NE(bytes.find(R"("name":"floor","extras")"), std::string::npos);
    EXPECT_EQ(bytes.size() % 4, 0U);
    write_glb(path, mesh,
              {{{"part", {1, 0, 0, 0, 0, 1}}, {"piece", {1, 1, 2, 1, 2, 1}}}, {}, {"roof", "floor"}});
    const std::string pieces = test::content_of(path);
    for (const char* name : {R"("name":"roof 1","extras":{"part":0,"piece":1})", R"("name":"roof 2")",
                             R"("name":"floor 1")", R"("name":"roof","extras":{"part":0},"children":[0,1])"})
        EXPECT_NE(pieces.find(name), std::string::npos) << name;
}

std::string in_utf16(const std::string& text) {
    std::string bytes = "\xff\xfe";
    for (const char c : text) bytes.append({c, '\0'});
    return bytes;
}

TEST(GltfFormat, JsonInOtherEncodingsIsReadAndExported) {
    const test::TemporaryFolder folder;
    folder.file("data.bin", test::tetrahedron_bytes());
    const std::string json =
        with(tetrahedron_json, R"({"byteLength":72})", R"({"byteLength":72,"uri":"data.bin"})");
    for (const std::string& text : {json, in_utf16(json), "\xEF\xBB\xBF" + json}) {
        const std::string path = folder.file("a.gltf", text);
        EXPECT_EQ(corners_of(read_mesh(path)), all_corners);
        write_glb_like(folder.path("a.glb"), {path, mesh_file_bytes(path)}, {{{"part", {0, 0, 0, 0}}}, {}});
        EXPECT_EQ(corners_of(read_mesh(folder.path("a.glb"))), all_corners);
    }
}

/// The tetrahedron, of whose vertices only the three that are not 0 stand in the file.
const std::string sparse_only =
    with(tetrahedron_json, R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})",
         R"({"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":3,)"
         R"("indices":{"bufferView":1,"byteOffset":18,"componentType":5123},)"
         R"("values":{"bufferView":0,"byteOffset":12}}})");

TEST(GltfFormat, SparseElementsMayStandAmongZeros) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("a.glb", tetrahedron_glb(sparse_only));
    EXPECT_EQ(corners_of(read_mesh(path)), all_corners);
    for (const int last : {0, -1}) {  // the whole mesh, and a part alone with its own vertices
        write_glb_like(folder.path("b.glb"), {path, mesh_file_bytes(path)},
                       {{{"part", {0, 0, 0, last}}}, {}});
        std::vector<Eigen::Vector3d> expected = all_corners;
        if (last < 0) expected.resize(9);
        EXPECT_EQ(corners_of(read_mesh(folder.path("b.glb"))), expected);
    }
    const std::string sentence =
        refusal_of(tetrahedron_glb(with(sparse_only, R"("count":4)", R"("count":4000000)")));
    EXPECT_NE(sentence.find("accessors[0] has 4000000 elements without bytes"), std::string::npos)
        << sentence;
}

TEST(GltfFormat, ASceneThatDrawsNoMeshIsSaidToBeOne) {
    for (const auto& [from, to] :
         {std::pair(R"({"nodes":[0]})", R"({"nodes":[]})"), std::pair(R"([{"mesh":0}])", R"([{}])")}) {
        const std::string sentence = refusal_of(tetrahedron_glb(with(tetrahedron_json, from, to)));
        EXPECT_NE(sentence.find("holds 1 mesh, but no node of its scene draws one"), std::string::npos)
            << sentence;
    }
}

}  // namespace
}  // namespace coseg
