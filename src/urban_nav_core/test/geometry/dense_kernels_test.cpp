// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/dense_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_core::kernels {
namespace {

std::vector<double> numbers(int n, double pace) {
  std::vector<double> made(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) made[static_cast<std::size_t>(i)] = std::sin(pace * i + 0.1);
  return made;
}

TEST(DenseKernels, AgreeWithThePlainSums) {
  for (const InstructionSet& set : instructionSets())
    for (int n = 0; n < 70; ++n) {
      const std::vector<double> a = numbers(n, 0.7), b = numbers(n, 1.3), c = numbers(n, 2.1), before = numbers(n, 0.4);
      double product = 0.0;
      std::vector<double> one = before, three = before;
      const double factors[3] = {0.3, -1.7, 2.9};
      for (std::size_t i = 0; i < a.size(); ++i) {
        product += a[i] * b[i];
        one[i] -= 0.3 * a[i];
        three[i] -= factors[0] * a[i] + factors[1] * b[i] + factors[2] * c[i];
      }
      EXPECT_NEAR(set.dot(a.data(), b.data(), n), product, 1e-13) << set.name << ' ' << n;
      std::vector<double> y = before;
      set.subtract(y.data(), a.data(), 0.3, n);
      for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], one[i], 1e-15) << set.name << ' ' << n;
      y = before;
      set.subtractThree(y.data(), a.data(), b.data(), c.data(), factors, n);
      for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], three[i], 1e-14) << set.name << ' ' << n;
    }
}

TEST(DenseKernels, SixProductsAreThoseOfOneByOne) {
  const auto sets = instructionSets();
  for (int n = 0; n < 40; ++n) {
    const int stride = n + 3;
    const std::vector<double> a = numbers(n, 0.7), b = numbers(6 * stride, 1.3);
    double first[6], products[6];
    sets.front().dotSix(a.data(), b.data(), stride, n, first);
    for (const InstructionSet& set : sets) {
      set.dotSix(a.data(), b.data(), stride, n, products);
      for (int c = 0; c < 6; ++c) {
        EXPECT_NEAR(products[c], set.dot(a.data(), b.data() + c * stride, n), 1e-13) << set.name << ' ' << n;
        EXPECT_EQ(products[c], first[c]) << set.name << ' ' << n;
      }
    }
  }
}

TEST(DenseKernels, EightRightHandSidesAreThoseOfOneByOne) {
  const auto sets = instructionSets();
  for (const int rows : {1, 3, 8, 13})
    for (const int columns : {0, 1, 6, 17})
      for (const bool turned : {false, true}) {
        const int row_step = turned ? columns + 2 : 1, column_step = turned ? 1 : rows + 2;
        const std::vector<double> L = numbers((rows + 2) * (columns + 2), 0.7), X = numbers(8 * columns, 1.3),
                                  before = numbers(8 * rows, 0.4);
        std::vector<double> first = before;
        sets.front().subtractEight(first.data(), rows, L.data(), row_step, column_step, X.data(), columns);
        for (std::size_t i = 0; i < first.size(); ++i) {
          double product = 0.0;
          for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k)
            product += L[i / 8 * static_cast<std::size_t>(row_step) + k * static_cast<std::size_t>(column_step)] *
                       X[8 * k + i % 8];
          EXPECT_NEAR(first[i], before[i] - product, 1e-13);
        }
        for (const InstructionSet& set : sets) {
          std::vector<double> Y = before;
          set.subtractEight(Y.data(), rows, L.data(), row_step, column_step, X.data(), columns);
          EXPECT_EQ(Y, first) << set.name << ' ' << rows << " x " << columns;
        }
      }
}

TEST(DenseKernels, GiveTheSameBitsWithEveryInstructionSet) {
  const auto sets = instructionSets();
  for (int n = 0; n < 70; ++n) {
    const std::vector<double> a = numbers(n, 0.7), b = numbers(n, 1.3), c = numbers(n, 2.1);
    const double factors[3] = {0.3, -1.7, 2.9};
    std::vector<double> one = c, three = c;
    sets.front().subtract(one.data(), a.data(), 0.3, n);
    sets.front().subtractThree(three.data(), a.data(), b.data(), a.data(), factors, n);
    for (const InstructionSet& set : sets) {
      EXPECT_EQ(set.dot(a.data(), b.data(), n), sets.front().dot(a.data(), b.data(), n)) << set.name << ' ' << n;
      std::vector<double> y = c;
      set.subtract(y.data(), a.data(), 0.3, n);
      EXPECT_EQ(y, one) << set.name << ' ' << n;
      y = c;
      set.subtractThree(y.data(), a.data(), b.data(), a.data(), factors, n);
      EXPECT_EQ(y, three) << set.name << ' ' << n;
    }
  }
}

}  // namespace
}  // namespace urban_nav_core::kernels
