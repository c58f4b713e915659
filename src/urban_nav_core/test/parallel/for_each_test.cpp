// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parallel/for_each.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace urban_nav_core {
namespace {

TEST(ForEach, VisitsEachOnce) {
  for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 1000U}) {
    std::vector<int> visits(count, 0);
    forEach(count, 8, [&visits](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

TEST(SumInOrder, DoesNotDependOnTheThreads) {
  constexpr std::size_t kCount = 100000;
  const auto term = [](std::size_t i) {
    return std::sin(static_cast<double>(i)) * std::pow(10.0, static_cast<double>(i % 17) - 8.0);
  };
  const auto sum = [&term](int threads) {
    const ThreadLimit limit(threads);
    return sumInOrder(kCount, 100, 0.0, term);
  };
  const double one = sum(1);
  for (int run = 0; run < 5; ++run) {
    EXPECT_EQ(sum(2), one);
    EXPECT_EQ(sum(4), one);
    EXPECT_EQ(sum(0), one);
  }
}

TEST(SumInOrder, AddsFromLeftToRightWithinAPiece) {
  const std::vector<double> values = {1e100, 1.0, -1e100, 1.0};
  const auto term = [&values](std::size_t i) { return values[i]; };
  EXPECT_EQ(sumInOrder(4, 4, 0.0, term), 1.0);
  EXPECT_EQ(sumInOrder(4, 2, 0.0, term), 0.0);  // the partition is part of the result
  EXPECT_EQ(sumInOrder(0, 4, 0.0, term), 0.0);
}

TEST(SumInOrder, TakesAnyTypeThatAdds) {
  const auto term = [](std::size_t i) { return std::string(1, static_cast<char>('a' + i)); };
  EXPECT_EQ(sumInOrder(26, 3, std::string(), term), "abcdefghijklmnopqrstuvwxyz");
}

TEST(ForEach, ThrowsTheExceptionOfTheFirstPiece) {
  for (int run = 0; run < 20; ++run) {
    try {
      forEach(1000, 10, [](std::size_t i) {
        if (i % 100 == 55) throw std::runtime_error(std::to_string(i));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "55");
    }
  }
}

TEST(ForEach, MayBeNested) {
  const double sum = sumInOrder(20, 1, 0.0, [](std::size_t i) {
    return sumInOrder(10, 3, 0.0, [i](std::size_t k) { return static_cast<double>(i * k); });
  });
  EXPECT_EQ(sum, 190.0 * 45.0);
}

}  // namespace
}  // namespace urban_nav_core
