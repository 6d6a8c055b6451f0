#include "solvers/row_scope/row_exchange.hpp"

#include <gtest/gtest.h>

#include "src/base/error.hpp"

namespace coseg {
namespace {

TEST(RowExchange, RefusesMoreValuesThanAMessageHolds) {
    constexpr std::int64_t most = 2147483647;
    EXPECT_NO_THROW(refuse_long_exchange(most, 1));
    EXPECT_THROW(refuse_long_exchange(most + 1, 1), Error);
    EXPECT_NO_THROW(refuse_long_exchange(most / 5, 5));
    EXPECT_THROW(refuse_long_exchange(most / 5 + 1, 5), Error);
    EXPECT_THROW(refuse_long_exchange(std::int64_t{1} << 40, 5), Error) << "far beyond 32 bits";
}

}  // namespace
}  // namespace coseg
