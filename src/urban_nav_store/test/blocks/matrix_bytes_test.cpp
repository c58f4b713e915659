// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/matrix_bytes.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/contents.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;

TEST(MatrixBytes, RoundTripAndRefusal) {
  Drawn drawn(1);
  const urban_nav_core::Matrix6d matrix = drawn.matrix();
  urban_nav_core::Matrix6d back;
  ASSERT_TRUE(parseMatrix(matrixBytes(matrix), back));
  EXPECT_EQ(back, matrix);
  urban_nav_core::Matrix6d symmetric = matrix;  // made symmetric below
  symmetric(4, 1) = symmetric(1, 4) + 1.0;
  ASSERT_TRUE(parseMatrix(matrixBytes(symmetric), back));
  EXPECT_EQ(back, symmetric);
  EXPECT_EQ(matrixBytes(symmetric).size(), 288U);
  symmetric = (matrix + matrix.transpose()).eval();
  ASSERT_TRUE(parseMatrix(matrixBytes(symmetric), back));
  EXPECT_EQ(back, symmetric);
  EXPECT_EQ(matrixBytes(symmetric).size(), 168U);
  EXPECT_FALSE(parseMatrix(matrixBytes(matrix).substr(1), back));
  urban_nav_core::Matrix6d bad = matrix;
  bad(2, 3) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(parseMatrix(matrixBytes(bad), back));
}

}  // namespace
}  // namespace urban_nav_store
