// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/allocations.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <memory>
#include <vector>

namespace urban_nav_core::testing {
namespace {

TEST(Allocations, CountsNewMallocAndEigen) {
  if (!countsAllocations()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  const AllocationCount count;
  EXPECT_EQ(count.sofar(), 0);
  const std::vector<int> a(1000, 1);
  EXPECT_EQ(count.sofar(), 1);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Zero(50, 50);
  EXPECT_EQ(count.sofar(), 2);
  std::free(std::malloc(10));
  const auto c = std::make_unique<double>(1.0);
  EXPECT_GE(count.sofar(), 3);
  EXPECT_EQ(a[7] + static_cast<int>(b(3, 3)), 1);
}

TEST(Allocations, SmallFixedMatricesAreFree) {
  const AllocationCount count;
  const Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Identity();
  const Eigen::Matrix<double, 6, 6> b = a * a.transpose();
  EXPECT_EQ(b(0, 0), 1.0);
  EXPECT_EQ(count.sofar(), 0);
}

}  // namespace
}  // namespace urban_nav_core::testing
