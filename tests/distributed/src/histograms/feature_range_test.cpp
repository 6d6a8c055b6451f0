#include "src/histograms/feature_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/histograms/histogram.hpp"

namespace coseg {
namespace {

/// Meshes of very different sizes with skewed values.
struct Collection {
    std::vector<Eigen::VectorXd> values;
    std::vector<Eigen::VectorXd> weights;

    explicit Collection(const std::vector<int>& faces) {
        for (std::size_t m = 0; m < faces.size(); ++m) {
            SeededStream random(hash_words({17, m}));
            values.emplace_back(faces[m]);
            weights.emplace_back(faces[m]);
            for (double& value : values.back()) value = std::exp(random.normal()) + static_cast<double>(m);
            for (double& weight : weights.back()) weight = random.uniform();
        }
    }

    /// Those of `comm`'s rank when rank 0 takes every second mesh and the others share the rest unevenly; a
    /// last rank of four gets none.
    [[nodiscard]] std::vector<FeatureOfMesh> dealt(const Comm& comm) const {
        std::vector<FeatureOfMesh> mine;
        for (std::size_t m = values.size(); m-- > 0;) {
            const int owner = m % 2 == 0 ? 0 : static_cast<int>(m / 2) % std::max(1, comm.size() - 1);
            if (owner == comm.rank()) mine.push_back({hash_words({m}), &values[m], &weights[m]});
        }
        return mine;
    }
};

TEST(FeatureRange, IsTheSameOnAnyNumberOfRanks) {
    const Comm world(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const Collection small({10, 2000, 1, 300, 4000, 7});
    const Collection large({200'000, 10, 150'000});
    for (const Collection* collection : {&small, &large}) {
        for (const auto kind :
             {RangeKind::per_mesh_percentile, RangeKind::global_percentile, RangeKind::equal_mass}) {
            const FeatureRange shared = agree_on_range(world, kind, 100, collection->dealt(world), 5);
            const FeatureRange alone = agree_on_range(self, kind, 100, collection->dealt(self), 5);
            EXPECT_EQ(shared.edges, alone.edges);
            EXPECT_EQ(shared.bins(), 100);
            EXPECT_TRUE(std::is_sorted(shared.edges.begin(), shared.edges.end()));
        }
    }
}

/// The share of the collection's weight in each bin.
Eigen::VectorXd mass_per_bin(const Collection& collection, const FeatureRange& range) {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(range.bins());
    for (std::size_t m = 0; m < collection.values.size(); ++m) {
        const std::vector<int> bin = bin_of_face(collection.values[m], range);
        for (std::size_t f = 0; f < bin.size(); ++f)
            mass[bin[f]] += collection.weights[m][static_cast<Eigen::Index>(f)];
    }
    return mass / mass.sum();
}

TEST(FeatureRange, EqualMassBinsHoldTheSameWeight) {
    const Comm world(MPI_COMM_WORLD);
    const Collection all_gathered({10, 20'000, 1, 3000});
    const FeatureRange exact =
        agree_on_range(world, RangeKind::equal_mass, 100, all_gathered.dealt(world), 5);
    EXPECT_LT((mass_per_bin(all_gathered, exact).array() - 0.01).abs().maxCoeff(), 2e-4);
    const Collection sampled({200'000, 10, 150'000});
    const FeatureRange near = agree_on_range(world, RangeKind::equal_mass, 100, sampled.dealt(world), 5);
    EXPECT_LT((mass_per_bin(sampled, near).array() - 0.01).abs().maxCoeff(), 1e-3);
}

TEST(FeatureRange, PercentilesIgnoreOutliersAndUniformBinsAreEqual) {
    const Comm world(MPI_COMM_WORLD);
    Collection collection({1000});
    collection.values[0] = Eigen::VectorXd::LinSpaced(1000, 1.0, 1000.0);
    collection.weights[0].setOnes();
    collection.values[0][999] = 1e9;
    const FeatureRange range =
        agree_on_range(world, RangeKind::global_percentile, 98, collection.dealt(world), 5);
    EXPECT_EQ(range.edges.front(), 10.0);
    EXPECT_EQ(range.edges.back(), 990.0);
    for (int b = 0; b <= 98; ++b)
        EXPECT_NEAR(range.edges[static_cast<std::size_t>(b)], 10.0 + 10.0 * b, 1e-9);
    const FeatureRange rescaled = agree_on_range(world, RangeKind::per_mesh_percentile, 4, {}, 5);
    EXPECT_EQ(rescaled.edges, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
}

TEST(FeatureRange, EveryRankLearnsOfAValueThatIsNoNumber) {
    const Comm world(MPI_COMM_WORLD);
    Collection collection({10, 20, 30});
    collection.values[0][3] = std::nan("");
    EXPECT_THROW((void)agree_on_range(world, RangeKind::equal_mass, 10, collection.dealt(world), 5),
                 AgreedError);
    EXPECT_THROW((void)agree_on_range(world, RangeKind::equal_mass, 10, {}, 5), AgreedError);
    EXPECT_THROW((void)agree_on_range(world, RangeKind::equal_mass, 0, {}, 5), AgreedError);
}

}  // namespace
}  // namespace coseg
