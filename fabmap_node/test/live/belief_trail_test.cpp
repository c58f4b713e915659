// SPDX-License-Identifier: BSD-3-Clause
#include "live/belief_trail.hpp"

#include <gtest/gtest.h>

namespace fabmap_node {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kTrailPeriod = 1'000'000'000;

/// A pose a second, 2 m apart.
void drive(BeliefTrail& trail, StampNs from, int poses) {
  for (int i = 0; i < poses; ++i)
    trail.addOdometry({from + i * kTrailPeriod, {urban_nav_core::Quaterniond::Identity(), {2.0 * i, 0.0, 0.0}}});
}

PlaceBelief beliefAt(StampNs stamp) {
  PlaceBelief belief;
  belief.at = {"", stamp};
  belief.knowledge = PlaceKnowledge::Known;
  belief.p_new = 0.005;
  belief.likeliest = {{{"", stamp - 60 * kTrailPeriod}, 0.995, 0.0, {}}};
  return belief;
}

TEST(BeliefTrail, BeliefsAreAtTheirPosesOfOdometry) {
  BeliefTrail trail;
  drive(trail, 100 * kTrailPeriod, 11);
  trail.add(beliefAt(103 * kTrailPeriod));
  trail.add(beliefAt(105 * kTrailPeriod + kTrailPeriod / 2));
  ASSERT_EQ(trail.points().size(), 2U);
  EXPECT_EQ(trail.points()[0].p_odom.x(), 6.0);
  EXPECT_EQ(trail.points()[1].p_odom.x(), 11.0);
  EXPECT_EQ(trail.points()[1].likeliest->at.stamp, 45 * kTrailPeriod + kTrailPeriod / 2);
  EXPECT_EQ(trail.find(103 * kTrailPeriod), &trail.points()[0]);
  EXPECT_EQ(trail.find(104 * kTrailPeriod), nullptr);
}

TEST(BeliefTrail, ARevisedBeliefStaysWhereItIs) {
  BeliefTrail trail;
  drive(trail, 100 * kTrailPeriod, 11);
  trail.add(beliefAt(103 * kTrailPeriod));
  trail.add(beliefAt(105 * kTrailPeriod));
  const std::size_t count = trail.count();
  PlaceBelief revised = beliefAt(103 * kTrailPeriod);
  revised.knowledge = PlaceKnowledge::Unsure;
  revised.p_new = 0.4;
  trail.revise(revised);
  ASSERT_EQ(trail.points().size(), 2U);
  EXPECT_EQ(trail.points()[0].knowledge, PlaceKnowledge::Unsure);
  EXPECT_EQ(trail.points()[0].p_new, 0.4);
  EXPECT_EQ(trail.points()[0].p_odom.x(), 6.0);
  EXPECT_EQ(trail.points()[1].knowledge, PlaceKnowledge::Known);
  EXPECT_GT(trail.count(), count);
  trail.revise(beliefAt(104 * kTrailPeriod));
  EXPECT_EQ(trail.points().size(), 2U);
}

TEST(BeliefTrail, WaitsForOdometryAndLeavesOutWhatWasBeforeIt) {
  BeliefTrail trail;
  trail.add(beliefAt(90 * kTrailPeriod));
  trail.add(beliefAt(109 * kTrailPeriod));
  trail.add(beliefAt(111 * kTrailPeriod));
  EXPECT_TRUE(trail.points().empty());
  drive(trail, 100 * kTrailPeriod, 11);
  ASSERT_EQ(trail.points().size(), 1U);
  EXPECT_EQ(trail.points()[0].stamp, 109 * kTrailPeriod);
  EXPECT_EQ(trail.count(), 1U);
  drive(trail, 111 * kTrailPeriod, 1);
  EXPECT_EQ(trail.count(), 2U);
}

TEST(BeliefTrail, LeavesOutWhatIsUnusedOrStationaryAndClearsWhenTimeGoesBack) {
  BeliefTrail trail;
  drive(trail, 100 * kTrailPeriod, 11);
  PlaceBelief dark = beliefAt(101 * kTrailPeriod), stationary = beliefAt(102 * kTrailPeriod);
  dark.observation = ObservationStatus::Dark;
  stationary.is_stationary = true;
  trail.add(dark);
  trail.add(stationary);
  EXPECT_TRUE(trail.points().empty());
  trail.add(beliefAt(105 * kTrailPeriod));
  drive(trail, 50 * kTrailPeriod, 11);
  EXPECT_EQ(trail.points().size(), 1U);
  trail.add(beliefAt(55 * kTrailPeriod));
  ASSERT_EQ(trail.points().size(), 1U);
  EXPECT_EQ(trail.points()[0].p_odom.x(), 10.0);
}

TEST(BeliefTrail, ItsLengthIsBounded) {
  BeliefTrail trail;
  for (int i = 0; i < 6000; ++i) {
    drive(trail, (100 + i) * kTrailPeriod, 1);
    trail.add(beliefAt((100 + i) * kTrailPeriod));
  }
  EXPECT_EQ(trail.points().size(), 5000U);
  EXPECT_EQ(trail.points().front().stamp, 1100 * kTrailPeriod);
  EXPECT_EQ(trail.count(), 6000U);
}

}  // namespace
}  // namespace fabmap_node
