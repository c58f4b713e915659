// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/closure.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "urban_nav_core/types/graph_update.hpp"

namespace urban_nav_core {
namespace {

TEST(PoseRef, ComparesAndSortsBySessionThenTime) {
  const PoseRef first{"a", 9}, second{"b", 1}, third{"b", 2};
  EXPECT_TRUE(first < second);
  EXPECT_TRUE(second < third);
  EXPECT_FALSE(third < second);
  EXPECT_FALSE(first < first);
  EXPECT_EQ(third, (PoseRef{"b", 2}));
  EXPECT_FALSE(third == second);
  EXPECT_FALSE((PoseRef{"a", 2}) == third);
}

TEST(PoseRef, Prints) {
  std::ostringstream out;
  out << PoseRef{"", 1'500'000'000} << " / " << PoseRef{"0123", 2'000'000'001};
  EXPECT_EQ(out.str(), "1.500000000 s / 0123 2.000000001 s");
}

TEST(Closure, MethodAndVerdictPrintAndReadBack) {
  for (const ClosureMethod method : {ClosureMethod::None, ClosureMethod::Stereo, ClosureMethod::Icp})
    EXPECT_EQ(parseClosureMethod(toString(method)), method);
  EXPECT_STREQ(toString(ClosureMethod::Icp), "icp");
  EXPECT_FALSE(parseClosureMethod("ICP"));
  for (const ClosureVerdict verdict :
       {ClosureVerdict::Accepted, ClosureVerdict::Rejected, ClosureVerdict::Waiting, ClosureVerdict::Degenerate})
    EXPECT_EQ(parseClosureVerdict(toString(verdict)), verdict);
  EXPECT_FALSE(parseClosureVerdict(""));
}

TEST(Closure, IsEmptyUntilItIsFilled) {
  const MetricClosure closure;
  EXPECT_EQ(closure.verdict, ClosureVerdict::Rejected);
  EXPECT_TRUE(closure.measured.information.isZero(0.0));
}

TEST(EdgeRef, ComparesAllItsParts) {
  const EdgeRef edge{{"s", 1}, {"s", 2}, "stereo", "loop_metric"};
  EXPECT_EQ(edge, (EdgeRef{{"s", 1}, {"s", 2}, "stereo", "loop_metric"}));
  EXPECT_FALSE(edge == (EdgeRef{{"t", 1}, {"s", 2}, "stereo", "loop_metric"}));
  EXPECT_FALSE(edge == (EdgeRef{{"s", 1}, {"s", 3}, "stereo", "loop_metric"}));
  EXPECT_FALSE(edge == (EdgeRef{{"s", 1}, {"s", 2}, "icp", "loop_metric"}));
  EXPECT_FALSE(edge == (EdgeRef{{"s", 1}, {"s", 2}, "stereo", ""}));
}

}  // namespace
}  // namespace urban_nav_core
