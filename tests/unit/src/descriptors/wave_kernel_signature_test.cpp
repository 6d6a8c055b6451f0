#include "src/descriptors/wave_kernel_signature.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdio>

#include "src/mesh/dual_graph.hpp"
#include "tests/support/awkward_shapes.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

Eigen::MatrixXf signature_of(const TriMesh& mesh) {
    const FaceGeometry geometry = face_geometry(mesh);
    return wave_kernel_signature(
        mesh, geometry, laplacian_spectrum(mesh, geometry, dual_graph(mesh, geometry), wave_kernel_pairs));
}

// All places of a sphere are alike: every full group of eigenfunctions adds up to a constant.
TEST(WaveKernelSignature, OfASphereIsTheMeanEverywhere) {
    EXPECT_LT(signature_of(test::sphere(4)).cwiseAbs().maxCoeff(), 0.05F);
}

TEST(WaveKernelSignature, IsUnchangedByScaleRotationAndOrder) {
    const TriMesh mesh = test::limbed_body(3);
    const Eigen::MatrixXf signature = signature_of(mesh);
    ASSERT_EQ(signature.rows(), wave_kernel_energies);
    ASSERT_EQ(signature.cols(), mesh.face_count());
    TriMesh moved = mesh;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    moved.vertices = (7.0 * turn * mesh.vertices).colwise() + Eigen::Vector3d(4, 5, 6);
    EXPECT_LT((signature_of(moved) - signature).cwiseAbs().maxCoeff(), 1e-3F);
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 5, order);
    const Eigen::MatrixXf other = signature_of(shuffled);
    for (std::size_t k = 0; k < order.size(); ++k)
        ASSERT_LT((other.col(static_cast<Eigen::Index>(k)) - signature.col(order[k])).cwiseAbs().maxCoeff(),
                  1e-3F)
            << k;
}

TEST(WaveKernelSignature, HasTheMeanOneOverTheSurface) {
    const TriMesh mesh = test::limbed_body(3);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::MatrixXf signature = signature_of(mesh);
    for (Eigen::Index e = 0; e < signature.rows(); ++e) {
        const Eigen::VectorXd ratio = signature.row(e).cast<double>().array().exp().matrix().transpose();
        EXPECT_NEAR(ratio.dot(geometry.area) / geometry.total_area, 1.0, 2e-3) << e;
    }
}

TEST(WaveKernelSignature, TellsATipFromTheBody) {
    const TriMesh mesh = test::limbed_body(4);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd level = wave_kernel_level(signature_of(mesh));
    int tip = 0, highest = 0;
    geometry.centroid.row(0).maxCoeff(&tip);
    level.maxCoeff(&highest);
    EXPECT_LT((geometry.centroid.col(highest) - geometry.centroid.col(tip)).norm(), 0.5);
}

TEST(WaveKernelSignature, IsFiniteOnAwkwardMeshes) {
    EXPECT_TRUE(signature_of(test::flat_square(3)).allFinite());
    EXPECT_TRUE(signature_of(test::sphere(0)).allFinite());
    EXPECT_TRUE(signature_of(test::disjoint_union(test::sphere(2), test::sphere(2, 0.05))).allFinite());
    TriMesh single;
    single.vertices = Eigen::Matrix3d::Identity();
    single.faces = Eigen::Vector3i(0, 1, 2);
    EXPECT_TRUE(signature_of(single).allFinite());
    TriMesh loose = test::sphere(1);  // a vertex that no face uses
    loose.vertices.conservativeResize(3, loose.vertex_count() + 1);
    loose.vertices.col(loose.vertex_count() - 1).setZero();
    EXPECT_TRUE(signature_of(loose).allFinite());
}

}  // namespace
}  // namespace coseg
