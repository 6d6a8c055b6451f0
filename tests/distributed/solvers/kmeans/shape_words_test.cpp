#include "solvers/kmeans/shape_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "solvers/kmeans/lloyd.hpp"
#include "solvers/kmeans/word_seeds.hpp"
#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

constexpr int dims = 30;

int true_group(std::size_t mesh, Eigen::Index face, int groups) {
    return static_cast<int>(hash_words({1, mesh, static_cast<std::uint64_t>(face)}) %
                            static_cast<std::uint64_t>(groups));
}

/// Columns of unit sum about `groups` centres, with noise of relative size `spread`.
std::vector<Eigen::MatrixXf> contexts(const std::vector<int>& faces, int groups, double spread) {
    std::vector<Eigen::MatrixXf> result;
    for (std::size_t m = 0; m < faces.size(); ++m) {
        SeededStream random(hash_words({2, m}));
        Eigen::MatrixXf context(dims, faces[m]);
        for (Eigen::Index f = 0; f < faces[m]; ++f) {
            const int group = true_group(m, f, groups);
            for (Eigen::Index d = 0; d < dims; ++d) {
                const double centre = uniform_of(hash_words({3, std::uint64_t(group), std::uint64_t(d)}));
                context(d, f) = static_cast<float>(centre * centre + spread * random.uniform());
            }
            // Not Eigen's sum, whose order depends on where the column lies: equal columns must stay equal.
            float total = 0.0F;
            for (Eigen::Index d = 0; d < dims; ++d) total += context(d, f);
            for (Eigen::Index d = 0; d < dims; ++d) context(d, f) /= total;
        }
        result.push_back(std::move(context));
    }
    return result;
}

/// Rank 0 holds every second mesh, the last rank of four none.
bool is_mine(const Comm& comm, std::size_t mesh) {
    const int owner = mesh % 2 == 0 ? 0 : static_cast<int>(mesh / 2) % std::max(1, comm.size() - 1);
    return owner == comm.rank();
}

std::vector<ShapeWordInput> dealt(const Comm& comm, const std::vector<Eigen::MatrixXf>& all) {
    std::vector<ShapeWordInput> mine;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (is_mine(comm, m)) mine.push_back({hash_words({m}), &all[m]});
    }
    return mine;
}

void expect_same_as_alone(const std::vector<Eigen::MatrixXf>& all, int words, std::uint64_t seed) {
    const Comm world(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const auto shared = shape_words(world, dealt(world, all), words, seed);
    const auto alone = shape_words(self, dealt(self, all), words, seed);
    std::size_t next = 0;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (!is_mine(world, m)) continue;
        ASSERT_LT(next, shared.size());
        EXPECT_EQ(shared[next++], alone[m]) << "mesh " << m;
    }
    EXPECT_EQ(next, shared.size());
}

TEST(ShapeWords, AreTheSameOnAnyNumberOfRanks) {
    const auto loose = contexts({700, 1, 3000, 0, 450, 1200, 90, 2000}, 12, 1.0);
    expect_same_as_alone(loose, 25, 1);
    expect_same_as_alone(loose, 1, 2);
    // More faces than the sample takes, so that both kinds of rounds run.
    expect_same_as_alone(contexts({30'000, 2000, 9000, 4000}, 10, 1.0), 40, 3);
}

TEST(ShapeWords, CentresGiveBackTheWordsOnceTheRoundsHaveEnded) {
    const Comm world(MPI_COMM_WORLD);
    const auto all = contexts({800, 1500, 60, 2000, 333}, 9, 0.02);
    Eigen::MatrixXf centres;
    const auto words = shape_words(world, dealt(world, all), 9, 1, &centres);
    ASSERT_EQ(centres.cols(), 9);
    ASSERT_EQ(centres.rows(), dims);
    std::size_t next = 0;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (!is_mine(world, m)) continue;
        EXPECT_EQ(words_of(all[m], centres), words[next++]) << m;
    }
    EXPECT_THROW((void)words_of(Eigen::MatrixXf::Ones(dims + 1, 2), centres), Error);
}

TEST(ShapeWords, SeparateWellSeparatedGroups) {
    const Comm world(MPI_COMM_WORLD);
    const int groups = 9;
    const auto all = contexts({800, 1500, 60, 2000, 333}, groups, 0.02);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const auto words = shape_words(world, dealt(world, all), groups, seed);
        std::set<std::pair<int, int>> pairs;
        std::size_t next = 0;
        for (std::size_t m = 0; m < all.size(); ++m) {
            if (!is_mine(world, m)) continue;
            for (std::size_t f = 0; f < words[next].size(); ++f) {
                const int word = words[next][f];
                ASSERT_TRUE(0 <= word && word < groups);
                pairs.emplace(true_group(m, static_cast<Eigen::Index>(f), groups), word);
            }
            ++next;
        }
        // One word a group and one group a word, over all ranks.
        std::vector<int> local;
        for (const auto& [group, word] : pairs) local.push_back(group * groups + word);
        const auto gathered = all_gather(world, std::span<const int>(local));
        EXPECT_EQ(std::set<int>(gathered.begin(), gathered.end()).size(), static_cast<std::size_t>(groups))
            << seed;
    }
}

TEST(ShapeWords, FewerDistinctContextsThanWordsEachGetTheirOwn) {
    const Comm world(MPI_COMM_WORLD);
    const auto all = contexts({50, 20, 9}, 4, 0.0);
    const auto words = shape_words(world, dealt(world, all), 100, 1);
    expect_same_as_alone(all, 100, 1);
    std::size_t next = 0;
    std::vector<int> word_of_group(4, -1);
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (!is_mine(world, m)) continue;
        for (std::size_t f = 0; f < words[next].size(); ++f) {
            int& known = word_of_group[std::size_t(true_group(m, static_cast<Eigen::Index>(f), 4))];
            if (known < 0) known = words[next][f];
            EXPECT_EQ(known, words[next][f]);
        }
        ++next;
    }
    std::set<int> used(word_of_group.begin(), word_of_group.end());
    used.erase(-1);
    EXPECT_EQ(used.size(), std::size_t(4 - std::count(word_of_group.begin(), word_of_group.end(), -1)));
}

TEST(ShapeWords, NoMeshAtAllIsNoError) {
    const Comm world(MPI_COMM_WORLD);
    EXPECT_TRUE(shape_words(world, {}, 10, 1).empty());
}

TEST(ShapeWords, EveryRankLearnsOfBadInput) {
    const Comm world(MPI_COMM_WORLD);
    auto all = contexts({40, 30}, 3, 1.0);
    EXPECT_THROW((void)shape_words(world, dealt(world, all), 0, 1), AgreedError);
    all[0](3, 7) = std::nanf("");
    EXPECT_THROW((void)shape_words(world, dealt(world, all), 5, 1), AgreedError);
    all[0] = Eigen::MatrixXf::Ones(dims + 1, 4);
    EXPECT_THROW((void)shape_words(world, dealt(world, all), 5, 1), AgreedError);
}

/// Plain k-means in double precision, every distance computed in every round.
std::vector<int> plain_lloyd(const Eigen::MatrixXd& points, Eigen::MatrixXd words, int rounds) {
    std::vector<int> word(std::size_t(points.cols()), -1);
    for (int round = 0; round <= rounds; ++round) {
        for (Eigen::Index i = 0; i < points.cols(); ++i) {
            Eigen::Index nearest = 0;
            (words.colwise() - points.col(i)).colwise().squaredNorm().minCoeff(&nearest);
            word[std::size_t(i)] = static_cast<int>(nearest);
        }
        Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(words.rows(), words.cols());
        Eigen::VectorXd counts = Eigen::VectorXd::Zero(words.cols());
        for (Eigen::Index i = 0; i < points.cols(); ++i) {
            sums.col(word[std::size_t(i)]) += points.col(i);
            counts[word[std::size_t(i)]] += 1.0;
        }
        for (Eigen::Index w = 0; w < words.cols(); ++w) {
            if (counts[w] > 0.0) words.col(w) = sums.col(w) / counts[w];
        }
    }
    return word;
}

TEST(Lloyd, SparedSearchesChangeNoAnswer) {
    const Comm world(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const auto all = contexts({1500}, 8, 1.0);
    const Eigen::MatrixXf seeds = word_seeds(all[0].transpose(), 20, 4);
    for (const int rounds : {0, 1, 8}) {
        Eigen::MatrixXf words = seeds;
        std::vector<WordedPoints> local;
        if (world.is_root()) local.push_back({&all[0], {}});
        lloyd_rounds(world, local, rounds, words);
        if (!world.is_root()) continue;
        const std::vector<int> expected = plain_lloyd(all[0].cast<double>(), seeds.cast<double>(), rounds);
        int different = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            different += expected[i] != local[0].word[i] ? 1 : 0;
        // A point halfway between two words may fall to either side in single precision.
        EXPECT_LE(different, 3) << rounds;
    }
}

}  // namespace
}  // namespace coseg
