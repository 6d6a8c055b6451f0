#include "solvers/spectral/diffusion_clusters.hpp"

#include <gtest/gtest.h>

#include <set>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Two features of points about `centres` corners of a simplex, which patch i belongs to in turn.
std::vector<Eigen::MatrixXd> clouds(int patches, int centres, double spread) {
    SeededStream random(7);
    std::vector<Eigen::MatrixXd> features(2, Eigen::MatrixXd::Zero(centres, patches));
    for (Eigen::MatrixXd& x : features) {
        for (int i = 0; i < patches; ++i) {
            for (int d = 0; d < centres; ++d)
                x(d, i) = (i % centres == d ? 1.0 : 0.0) + spread * random.normal();
        }
    }
    return features;
}

TEST(DiffusionClusters, CloudsApartAreFoundOnAnyNumberOfRanks) {
    const Comm world(MPI_COMM_WORLD);
    for (const int centres : {2, 3, 5}) {
        const std::vector<int> label =
            diffusion_clusters(world, clouds(150, centres, 0.05), {.parts = centres});
        ASSERT_EQ(label.size(), 150U);
        std::set<int> used(label.begin(), label.begin() + centres);
        EXPECT_EQ(used.size(), static_cast<std::size_t>(centres));
        for (std::size_t i = 0; i < label.size(); ++i)
            EXPECT_EQ(label[i], label[i % static_cast<std::size_t>(centres)]);
    }
}

TEST(DiffusionClusters, ScaleOfTheFeaturesDoesNotMatter) {
    const Comm world(MPI_COMM_WORLD);
    std::vector<Eigen::MatrixXd> features = clouds(90, 3, 0.3);
    const std::vector<int> label = diffusion_clusters(world, features, {.parts = 3});
    for (Eigen::MatrixXd& x : features) x *= 1024.0;
    EXPECT_EQ(diffusion_clusters(world, features, {.parts = 3}), label);
}

TEST(DiffusionClusters, RefusesWhatIsTooMuchOrTooLittle) {
    const Comm world(MPI_COMM_WORLD);
    EXPECT_THROW(diffusion_clusters(world, clouds(20, 2, 0.1), {.parts = 21}), Error);
    EXPECT_THROW(diffusion_clusters(world, clouds(20, 2, 0.1), {.parts = 2, .most = 19}), Error);
    EXPECT_THROW(diffusion_clusters(world, {}, {.parts = 2}), Error);
}

}  // namespace
}  // namespace coseg
