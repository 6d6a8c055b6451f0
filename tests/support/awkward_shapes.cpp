#include "tests/support/awkward_shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "src/base/seeded_random.hpp"
#include "src/mesh/face_geometry.hpp"
#include "tests/support/shapes.hpp"

namespace coseg::test {

namespace {

TriMesh single_triangle() {
    TriMesh mesh;
    mesh.vertices.resize(3, 3);
    mesh.vertices << 0, 1, 0, 0, 0, 1, 0, 0, 0;
    mesh.faces.resize(3, 1);
    mesh.faces << 0, 1, 2;
    return mesh;
}

TriMesh tetrahedron() {
    TriMesh mesh;
    mesh.vertices.resize(3, 4);
    mesh.vertices << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
    mesh.faces.resize(3, 4);
    mesh.faces << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
    return mesh;
}

/// One vertex moved onto an edge's middle (amount 0) or to a neighbour (amount 1): closed, with faces without
/// area.
TriMesh collapsed(double amount) {
    TriMesh mesh = box(1, 1, 1, 4);
    const Eigen::Vector3i face = mesh.faces.col(10);
    const Eigen::Vector3d a = mesh.vertices.col(face[1]);
    const Eigen::Vector3d b = mesh.vertices.col(face[2]);
    mesh.vertices.col(face[0]) = (0.5 + 0.5 * amount) * a + (0.5 - 0.5 * amount) * b;
    return mesh;
}

}  // namespace

TriMesh limbed_body(int levels) {
    TriMesh mesh = sphere(levels);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector3d p = mesh.vertices.col(v);
        const double limb = 2.5 * std::exp(-12.0 * (p - Eigen::Vector3d::UnitX()).squaredNorm());
        const double bumps =
            0.15 * std::sin(3.1 * p.x() + 0.7) * std::cos(2.3 * p.y() - 0.4) + 0.1 * std::sin(4.7 * p.z());
        mesh.vertices.col(v) *= 1.0 + limb + bumps;
    }
    return mesh;
}

TriMesh moved(const TriMesh& mesh, double radians) {
    TriMesh result = mesh;
    const Eigen::Vector3d axis = Eigen::Vector3d(0.3, -0.8, 0.5).normalized();
    result.vertices = Eigen::AngleAxisd(radians, axis).toRotationMatrix() * mesh.vertices;
    result.vertices.colwise() += Eigen::Vector3d(0.7, -1.3, 2.1);
    return result;
}

TriMesh jittered(const TriMesh& mesh, double amount) {
    TriMesh result = mesh;
    const double edge = std::sqrt(4.0 / std::sqrt(3.0) * face_geometry(mesh).total_area / mesh.face_count());
    SeededStream random(7);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) result.vertices(k, v) += amount * edge * random.uniform(-1.0, 1.0);
    }
    return result;
}

std::vector<std::pair<std::string, TriMesh>> awkward_meshes() {
    TriMesh needles = torus(1.0, 0.3, 40, 12);
    needles.vertices.row(2) *= 1e-7;
    TriMesh unused = sphere(1);
    unused.vertices.conservativeResize(3, unused.vertices.cols() + 1);
    unused.vertices.col(unused.vertices.cols() - 1).setConstant(0.1);
    TriMesh far_apart = sphere(1, 1e-3);
    far_apart.vertices.colwise() += Eigen::Vector3d(50, 0, 0);
    return {{"single triangle", single_triangle()},
            {"tetrahedron", tetrahedron()},
            {"open square", flat_square(5)},
            {"faces without area", collapsed(0.0)},
            {"coincident corners", collapsed(1.0)},
            {"flattened to needles", needles},
            {"box of needles", box(1, 1e-6, 1, 6)},
            {"two components", disjoint_union(box(1, 2, 3, 4), far_apart)},
            {"square and sphere", disjoint_union(flat_square(3), sphere(2, 0.1))},
            {"unused vertex", unused}};
}

}  // namespace coseg::test
