// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_division.hpp"

#include <gtest/gtest.h>

namespace urban_nav {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;

using Numbers = std::vector<std::size_t>;

MetricClosure closureBetween(const std::string& a, const std::string& b, ClosureVerdict verdict) {
  MetricClosure closure;
  closure.a = {a, 1};
  closure.b = {b, 2};
  closure.verdict = verdict;
  closure.measured.information.setIdentity();
  closure.reason_name = "few_matches";
  closure.sentence = "3 matches";
  return closure;
}

class MapDivision : public ::testing::Test {
 protected:
  MapDivision() { context.names = {"a", "b", "x", "c"}; }

  const MapOptions options;
  Console console;
  MapContext context{options, console};
};

TEST_F(MapDivision, OneMapIsOneGroup) {
  EXPECT_EQ(dividedGroups(context, {0, 0, 0, 0}), Numbers({0, 0, 0, 0}));
  EXPECT_EQ(sessionsOfGroups(context), std::vector<Numbers>({{0, 1, 2, 3}}));
}

TEST_F(MapDivision, AGroupHasTheSessionsOfAMap) {
  context.groups = dividedGroups(context, {0, 0, 2, 0});
  EXPECT_EQ(sessionsOfGroups(context), std::vector<Numbers>({{0, 1, 3}, {2}}));
}

// Otherwise two groups could become one map and divide again without end.
TEST_F(MapDivision, GroupsAreNeverUnited) {
  context.groups = {0, 0, 2, 0};
  EXPECT_EQ(dividedGroups(context, {0, 0, 0, 0}), context.groups);
  EXPECT_EQ(dividedGroups(context, {0, 1, 1, 0}), Numbers({0, 1, 2, 0}));
}

TEST_F(MapDivision, CandidatesBetweenGroupsAreKeptWithTheirReasons) {
  context.given = {closureBetween("b", "x", ClosureVerdict::Accepted)};
  context.closures = {context.given.front(), closureBetween("a", "b", ClosureVerdict::Accepted),
                      closureBetween("a", "x", ClosureVerdict::Accepted),
                      closureBetween("x", "c", ClosureVerdict::Rejected)};
  std::vector<ClosureAssessment> assessments(context.closures.size());
  assessments[2].reason = "contradicts odometry";
  divideGroups({0, 0, 2, 0}, context.closures, assessments, context);
  EXPECT_EQ(context.groups, Numbers({0, 0, 2, 0}));
  ASSERT_EQ(context.between_groups.size(), 2U) << "not those within a group, nor the given ones";
  EXPECT_EQ(context.between_groups[0].sentence, "contradicts odometry");
  EXPECT_EQ(context.between_groups[1].sentence, "3 matches");
  for (const MetricClosure& closure : context.between_groups) {
    EXPECT_EQ(closure.verdict, ClosureVerdict::Rejected);
    EXPECT_TRUE(closure.measured.information.isZero(0.0));
  }
  divideGroups({0, 1, 2, 0}, context.closures, assessments, context);
  EXPECT_EQ(context.between_groups.size(), 3U) << "each once";
}

}  // namespace
}  // namespace urban_nav
