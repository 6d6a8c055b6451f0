#include "io/mesh_files/mesh_format.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <vector>

#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/face_triangles.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;

TEST(MeshFormat, SuffixesAreLowerCaseAndUnique) {
    std::set<std::string_view> suffixes;
    for (const MeshFormat& format : mesh_formats()) {
        EXPECT_EQ(format.suffix, suffix_of("mesh" + std::string(format.suffix)));
        EXPECT_TRUE(suffixes.insert(format.suffix).second) << format.suffix;
        EXPECT_TRUE(format.read != nullptr || format.write != nullptr) << format.name;
        if (format.read == nullptr) continue;
        EXPECT_EQ(readable_format_of("folder.off/a.b" + std::string(format.suffix))->name, format.name);
    }
    EXPECT_EQ(readable_format_of("A.StL")->name, "STL");
    EXPECT_EQ(readable_format_of("a.vtk"), nullptr);
    EXPECT_EQ(readable_format_of("a.off.txt"), nullptr);
    EXPECT_EQ(readable_format_of("off"), nullptr);
    EXPECT_EQ(readable_format_of(".off"), nullptr);  // a hidden file without a suffix
}

TEST(MeshFormat, ListsForMessages) {
    EXPECT_EQ(readable_formats(), "OFF, OBJ, PLY, STL, GLB, glTF, VTP");
    EXPECT_EQ(readable_suffixes("or"), ".off, .obj, .ply, .stl, .glb, .gltf or .vtp");
}

bool holds_triangles_only(const std::string& name) { return name == "glb" || name == "stl"; }

PolygonMesh cut_into_triangles(const PolygonMesh& mesh) {
    PolygonMesh triangles;
    triangles.vertices = mesh.vertices;
    triangles.offsets.push_back(0);
    for (const FaceTriangle& triangle : face_triangles(mesh)) {
        triangles.corners.insert(triangles.corners.end(), triangle.vertices.begin(), triangle.vertices.end());
        triangles.offsets.push_back(static_cast<int>(triangles.corners.size()));
    }
    return triangles;
}

std::vector<Eigen::Vector3d> corner_positions(const PolygonMesh& mesh) {
    std::vector<Eigen::Vector3d> positions;
    for (const int corner : mesh.corners)
        positions.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
    return positions;
}

void expect_near(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b,
                 double distance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT((a[k] - b[k]).norm(), distance);
}

TEST(MeshFormat, WhatIsWrittenReadsBack) {
    const test::TemporaryFolder folder;
    const PolygonMesh mesh = test::polygons_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.75}},
                                               {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const FaceArrays arrays{{{"part", {0, 0, 1, 1, 2}}, {"patch", {4, 3, 2, 1, 0}}},
                            {{"height", {0, 1, 2, 3, 4}}}};
    for (const std::string& name : writable_formats()) {
        SCOPED_TRACE(name);
        const MeshFormat& format = writable_format(name);
        const std::string path = folder.path("mesh" + std::string(format.suffix));
        format.write(path, mesh, arrays);
        EXPECT_GT(fs::file_size(path), 80U);
        if (format.write_shared != nullptr) format.write_shared(folder.path(), 3);
        const test::Caught caught = test::error_of([&] {
            format.write(path, mesh, {{{"part", {0, 1}}}, {}});
        });
        EXPECT_EQ(caught.code, ExitCode::internal);
        const PolygonMesh back = read_mesh(path);
        const PolygonMesh& expected = holds_triangles_only(name) ? cut_into_triangles(mesh) : mesh;
        EXPECT_EQ(back.offsets, expected.offsets);
        EXPECT_EQ(corner_positions(back), corner_positions(expected));
        if (holds_triangles_only(name)) continue;
        EXPECT_EQ(back.corners, mesh.corners);
        EXPECT_EQ(back.vertices, mesh.vertices);
    }
    EXPECT_EQ(writable_formats(), (std::vector<std::string>{"off", "obj", "ply", "stl", "glb", "vtk"}));
    EXPECT_NE(test::content_of(folder.path("mesh.obj")).find("mtllib parts.mtl\n"), std::string::npos);
    EXPECT_NE(test::content_of(folder.path("parts.mtl")).find("newmtl part_2\n"), std::string::npos);
    EXPECT_EQ(test::error_of([] { writable_format("gltf"); }).code, ExitCode::internal);
}

TEST(MeshFormat, MapCoordinatesAreWrittenWithAllTheirDigits) {
    const test::TemporaryFolder folder;
    PolygonMesh mesh = test::polygons_of({{0, 0, 0}, {1.1, 0, 0}, {0, 1.3, 0}, {0, 0, 0.7}},
                                         {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
    for (Eigen::Vector3d& p : mesh.vertices) p += Eigen::Vector3d(5e5, 4.5e6, 100);
    for (const std::string& name : writable_formats()) {
        SCOPED_TRACE(name);
        const MeshFormat& format = writable_format(name);
        const std::string path = folder.path("map" + std::string(format.suffix));
        format.write(path, mesh, {{{"part", {0, 0, 1, 1}}}, {}});
        if (name == "glb")
            expect_near(corner_positions(read_mesh(path)), corner_positions(mesh), 1e-6);
        else
            EXPECT_EQ(corner_positions(read_mesh(path)), corner_positions(mesh));
    }
}

TEST(MeshFormat, ShapesTooSmallForSinglePrecisionKeepTheirForm) {
    const test::TemporaryFolder folder;
    for (const double scale : {1e-44, 1e-162, 1e-200, 1e-300}) {
        PolygonMesh mesh = test::polygons_of({{0, 0, 0}, {1.1, 0, 0}, {0, 1.3, 0}, {0, 0, 0.7}},
                                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
        for (Eigen::Vector3d& p : mesh.vertices) p *= scale;
        for (const std::string& name : writable_formats()) {
            SCOPED_TRACE(name + " " + std::to_string(std::log10(scale)));
            const MeshFormat& format = writable_format(name);
            const std::string path = folder.path("tiny" + std::string(format.suffix));
            format.write(path, mesh, {{{"part", {0, 0, 1, 1}}}, {}});
            const std::vector<Eigen::Vector3d> back = corner_positions(read_mesh(path));
            const std::vector<Eigen::Vector3d> corners = corner_positions(mesh);
            ASSERT_EQ(back.size(), corners.size());
            for (std::size_t k = 0; k < back.size(); ++k)
                EXPECT_LT((back[k] - corners[k]).cwiseAbs().maxCoeff(), 1e-6 * scale);
        }
    }
}

const fs::path source_folder =
    fs::path(__FILE__).parent_path().parent_path().parent_path().parent_path().parent_path();

TEST(MeshFormat, ScriptsThatCountMeshesKnowAllSuffixes) {
    for (const char* script : {"jobs/submit.sh", "jobs/scaling.py", "bench/assign.py"}) {
        const std::string text = test::content_of((source_folder / script).string());
        for (const MeshFormat& format : mesh_formats()) {
            if (format.read == nullptr) continue;
            EXPECT_NE(text.find(format.suffix.substr(1)), std::string::npos)
                << script << " " << format.suffix;
        }
    }
}

struct CorpusFile {
    std::string name;
    std::string bytes;
    bool is_readable;
};

/// tests/corpus/mesh_files, described in its README.md.
std::vector<CorpusFile> corpus() {
    std::vector<CorpusFile> files;
    for (const std::string folder : {"read", "refused"}) {
        for (const fs::directory_entry& entry :
             fs::directory_iterator(source_folder / "tests" / "corpus" / "mesh_files" / folder)) {
            files.push_back({entry.path().filename().string(), test::content_of(entry.path().string()),
                             folder == "read"});
        }
    }
    std::sort(files.begin(), files.end(), [](const CorpusFile& a, const CorpusFile& b) {
        return std::tie(a.is_readable, a.name) < std::tie(b.is_readable, b.name);
    });
    return files;
}

void expect_invariants(const PolygonMesh& mesh) {
    ASSERT_GE(mesh.face_count(), 1);
    ASSERT_EQ(mesh.offsets.front(), 0);
    ASSERT_EQ(mesh.offsets.back(), std::ssize(mesh.corners));
    ASSERT_TRUE(std::is_sorted(mesh.offsets.begin(), mesh.offsets.end()));
    for (const int corner : mesh.corners) ASSERT_TRUE(corner >= 0 && corner < mesh.vertex_count()) << corner;
    for (const Eigen::Vector3d& p : mesh.vertices) {
        for (const double value : p) ASSERT_TRUE(is_usable_coordinate(value)) << value;
    }
}

/// Whether it was read; anything but a sound mesh or a refusal that begins with the path fails the test.
bool is_read_or_refused(const std::string& name, const std::string& bytes) {
    PolygonMesh mesh;
    const test::Caught caught = test::error_of([&] { mesh = parse_mesh(bytes, name).mesh; });
    if (caught.threw) {
        EXPECT_EQ(caught.code, ExitCode::input);
        EXPECT_TRUE(caught.sentence.starts_with(name + ":")) << caught.sentence;
        EXPECT_GT(caught.sentence.size(), name.size() + 10);
    } else {
        expect_invariants(mesh);
    }
    return !caught.threw;
}

TEST(MeshFormat, CorpusIsReadAndRefusedAsItsFoldersSay) {
    const std::vector<CorpusFile> files = corpus();
    ASSERT_GT(files.size(), 100U);
    for (const CorpusFile& file : files) {
        SCOPED_TRACE(file.name);
        EXPECT_EQ(is_read_or_refused(file.name, file.bytes), file.is_readable);
    }
    for (const MeshFormat& format : mesh_formats()) {
        if (format.read == nullptr) continue;
        for (const bool is_readable : {true, false}) {
            EXPECT_GE(std::count_if(files.begin(), files.end(),
                                    [&](const CorpusFile& file) {
                                        return file.is_readable == is_readable &&
                                               suffix_of(file.name) == format.suffix;
                                    }),
                      5)
                << format.name;
        }
    }
}

TEST(MeshFormat, CorpusWithAByteChangedOrCutOffAnywhere) {
    constexpr std::size_t small = 1000;
    constexpr int changes_per_byte = 3;
    const std::string signs = "0123456789-+. \n\\e/#fv";
    SeededStream random(1);
    for (const CorpusFile& file : corpus()) {
        if (file.bytes.size() > small) continue;
        SCOPED_TRACE(file.name);
        // JSON and XML take longer to read than the rest, and most of their bytes are in all files the same.
        const std::string suffix = suffix_of(file.name);
        const std::size_t step = suffix == ".glb" || suffix == ".gltf" ? 11 : suffix == ".vtp" ? 5 : 1;
        for (std::size_t i = random() % step; i < file.bytes.size(); i += step) {
            is_read_or_refused(file.name, file.bytes.substr(0, i));
            for (int change = 0; change < changes_per_byte; ++change) {
                std::string bytes = file.bytes;
                if (change == 0)
                    bytes[i] = static_cast<char>(bytes[i] ^ (1 << random() % 8));
                else
                    bytes[i] = change == 1 ? static_cast<char>(random()) : signs[random() % signs.size()];
                is_read_or_refused(file.name, bytes);
                if (HasFatalFailure() || HasNonfatalFailure()) return;
            }
        }
    }
}

}  // namespace
}  // namespace coseg
