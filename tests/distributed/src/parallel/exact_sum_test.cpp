#include "src/parallel/exact_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/base/seeded_random.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {
namespace {

TEST(ExactSum, ScalarsAreExactWhateverTheirSizes) {
    const Comm self(MPI_COMM_SELF);
    ExactSum sum(0, 1.0, 4);
    for (const double value : {1e300, 1.0, -1e300, 1e-300}) sum.add_scalar(0, value);
    for (const double value : {-3.5, 1.25}) sum.add_scalar(1, value);
    for (int k = 0; k < 10; ++k) sum.add_scalar(2, std::numeric_limits<double>::denorm_min());
    sum.reduce(self);
    EXPECT_EQ(sum.scalar(0), 1.0);
    EXPECT_EQ(sum.scalar(1), -2.25);
    EXPECT_EQ(sum.scalar(2), 10 * std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(sum.scalar(3), 0.0);
    EXPECT_FALSE(sum.overflowed());
}

TEST(ExactSum, OrderDoesNotMatter) {
    const Comm self(MPI_COMM_SELF);
    ExactSum forward(1, 1e-3, 1);
    ExactSum backward(1, 1e-3, 1);
    long double expected = 0.0L;
    const auto value = [](int i) {
        return std::exp(20.0 * normal_of(hash_words({3, static_cast<std::uint64_t>(i)})));
    };
    const auto weight = [](int i) {
        return 1e-5 * uniform_of(hash_words({4, static_cast<std::uint64_t>(i)}));
    };
    long double field = 0.0L;
    for (int i = 0; i < 1000; ++i) {
        forward.add_scalar(0, value(i) * (i % 2 == 0 ? 1.0 : -1.0));
        forward.add_field(0, weight(i));
        expected += static_cast<long double>(value(i)) * (i % 2 == 0 ? 1.0L : -1.0L);
        field += static_cast<long double>(weight(i));
    }
    for (int i = 1000; i-- > 0;) {
        backward.add_scalar(0, value(i) * (i % 2 == 0 ? 1.0 : -1.0));
        backward.add_field(0, weight(i));
    }
    forward.reduce(self);
    backward.reduce(self);
    EXPECT_EQ(forward.scalar(0), backward.scalar(0));
    EXPECT_EQ(forward.field()[0], backward.field()[0]);
    EXPECT_NEAR(forward.scalar(0), static_cast<double>(expected),
                1e-14 * std::abs(static_cast<double>(expected)));
    EXPECT_NEAR(forward.field()[0], static_cast<double>(field), 1e-16);
}

TEST(ExactSum, OverflowIsSeen) {
    const Comm self(MPI_COMM_SELF);
    ExactSum sum(2, 1.0, 1);
    sum.add_field(1, 1e6);
    sum.reduce(self);
    EXPECT_TRUE(sum.overflowed());
    sum.clear();
    sum.add_field(0, 1e3);
    sum.reduce(self);
    EXPECT_FALSE(sum.overflowed());
    EXPECT_EQ(sum.field()[0], 1e3);
    sum.add_scalar(0, std::nan(""));
    sum.reduce(self);
    EXPECT_TRUE(sum.overflowed());
    for (int k = 0; k < 4; ++k) {
        sum.clear();
        for (int i = 0; i <= k; ++i) sum.add_field(0, -3e3);
        sum.reduce(self);
        EXPECT_EQ(sum.overflowed(), 3e3 * (k + 1) >= 0x1p13) << k;
    }
}

TEST(ExactSum, AFieldOfEitherSignIsExactAboveItsUnit) {
    const Comm comm(MPI_COMM_WORLD);
    ExactSum sum(3, 1.0, 0);
    const double part = comm.rank() % 2 == 0 ? 1.0 : -1.0;
    sum.add_field(0, -5.25);
    sum.add_field(1, part * 0.375);
    sum.add_field(1, part * 0x1p-79);
    sum.add_field(2, comm.is_root() ? -0x1p-79 : 0.0);
    sum.reduce(comm);
    EXPECT_EQ(sum.field()[0], -5.25 * comm.size());
    EXPECT_EQ(sum.field()[1], comm.size() % 2 == 0 ? 0.0 : 0.375 + 0x1p-79);
    EXPECT_EQ(sum.field()[2], -0x1p-79);
}

TEST(ExactSum, SameBitsOnAnyNumberOfRanks) {
    const Comm world(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    constexpr int n = 500;
    ExactSum shared(1, 1.0, 1);
    ExactSum alone(1, 1.0, 1);
    const BlockRange mine = block_range(n, world.size(), world.rank());
    for (int i = 0; i < n; ++i) {
        const double value = normal_of(hash_words({5, static_cast<std::uint64_t>(i)}));
        alone.add_scalar(0, value);
        alone.add_field(0, std::abs(value));
        if (!mine.contains(i)) continue;
        shared.add_scalar(0, value);
        shared.add_field(0, std::abs(value));
    }
    shared.reduce(world);
    alone.reduce(self);
    EXPECT_EQ(shared.scalar(0), alone.scalar(0));
    EXPECT_EQ(shared.field(), alone.field());
}

TEST(ExactSum, OfOrderOneKeepsWhatMattersBesideOne) {
    const Comm comm(MPI_COMM_WORLD);
    ExactSum sum = ExactSum::of_order_one(3);
    sum.add_scalar(0, 1.0);
    sum.add_scalar(0, -std::ldexp(1.0, -170));
    sum.add_scalar(0, -1.0);
    sum.add_scalar(1, std::ldexp(1.0, -200));
    sum.add_scalar(2, std::ldexp(-1.5, 76));
    sum.reduce(comm);
    EXPECT_FALSE(sum.overflowed());
    EXPECT_EQ(sum.scalar(0), -comm.size() * std::ldexp(1.0, -170));
    EXPECT_EQ(sum.scalar(1), 0.0);
    EXPECT_EQ(sum.scalar(2), comm.size() * std::ldexp(-1.5, 76));
}

TEST(ExactSum, OfOrderOneSaysWhatIsTooLarge) {
    const Comm comm(MPI_COMM_WORLD);
    ExactSum sum = ExactSum::of_order_one(1);
    if (comm.is_root()) sum.add_scalar(0, std::ldexp(1.0, 79));
    sum.reduce(comm);
    EXPECT_TRUE(sum.overflowed());
}

}  // namespace
}  // namespace coseg
