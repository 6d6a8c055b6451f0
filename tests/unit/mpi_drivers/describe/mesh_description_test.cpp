#include "mpi_drivers/describe/mesh_description.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

const DescriptionOptions few_samples{.seed = 1,
                                     .remesh = RemeshMode::automatic,
                                     .patches = 20,
                                     .oversegmentations = 1,
                                     .cut_noise = 0.3,
                                     .geodesic_samples = 20,
                                     .descriptors = {0, 1, 2, 3, 4}};

std::string off_text(const TriMesh& mesh) {
    std::ostringstream text;
    text.precision(17);
    text << "OFF\n" << mesh.vertex_count() << ' ' << mesh.face_count() << " 0\n";
    for (const auto& v : mesh.vertices.colwise()) text << v.transpose() << '\n';
    for (const auto& f : mesh.faces.colwise()) text << "3 " << f.transpose() << '\n';
    return text.str();
}

TriMesh triangle(double width, double height) {
    TriMesh mesh;
    mesh.vertices.resize(3, 3);
    mesh.vertices << 0.0, width, width / 2, 0.0, 0.0, height, 0.0, 0.0, 0.0;
    mesh.faces.resize(3, 1);
    mesh.faces << 0, 1, 2;
    return mesh;
}

MeshDescription description_of(const TriMesh& mesh, RemeshMode remesh = RemeshMode::automatic) {
    DescriptionOptions options = few_samples;
    options.remesh = remesh;
    return describe_mesh(0, "shape", "shape.off", off_text(mesh), options).mesh;
}

bool is_said(const MeshDescription& description, const std::string& words) {
    return std::any_of(description.warnings.begin(), description.warnings.end(),
                       [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

TEST(MeshDescription, ShapesThatCannotBeEvenGetAsManyTrianglesAsCoarseOnes) {
    const TriMesh box = test::box(1.0, 1.0, 1.0, 1);
    for (const TriMesh& mesh : {test::prism(0.5, 1e6, 16), test::prism(0.5, 1e9, 16),
                                test::disjoint_union(box, triangle(1e6, 1e-4))}) {
        for (const RemeshMode remesh : {RemeshMode::automatic, RemeshMode::always}) {
            const MeshDescription description = description_of(mesh, remesh);
            EXPECT_FALSE(description.remeshed);
            EXPECT_GE(description.graph.face_count, 20 * 60);
            EXPECT_LE(description.graph.face_count, 20 * 60 + 1);
            EXPECT_EQ(description.patch_counts.front(), 20);
            EXPECT_TRUE(is_said(description, "cannot be remeshed: "));
            EXPECT_TRUE(is_said(description, "refined internally"));
        }
        EXPECT_LE(description_of(mesh, RemeshMode::never).graph.face_count, 20 * 20 + 1);
    }
}

TEST(MeshDescription, StraySliversTakeNoMoreThanTheBudget) {
    const TriMesh box = test::box(1.0, 1.0, 1.0, 1);
    for (const TriMesh& mesh : {triangle(100.0, 1.0), test::disjoint_union(box, triangle(30.0, 1e-4)),
                                test::disjoint_union(box, triangle(100.0, 1e-4))}) {
        const MeshDescription description = description_of(mesh);
        EXPECT_TRUE(description.remeshed);
        EXPECT_GE(description.graph.face_count, 20 * 50);
        EXPECT_LE(description.graph.face_count, 20 * 60 * 5);
    }
}

}  // namespace
}  // namespace coseg
