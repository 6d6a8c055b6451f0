#include "src/base/decomposition.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace coseg {
namespace {

TEST(Decomposition, ThatFailsIsNamed) {
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
    EXPECT_EQ(succeeded(matrix.llt(), "a matrix").solve(Eigen::Vector2d(1.0, 2.0)),
              Eigen::Vector2d(1.0, 2.0));
    matrix(0, 0) = -1.0;
    EXPECT_THROW(succeeded(matrix.llt(), "a matrix"), Error);
}

}  // namespace
}  // namespace coseg
