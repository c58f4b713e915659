// SPDX-License-Identifier: BSD-3-Clause
#include "live/belief_trail.hpp"

#include <gtest/gtest.h>

namespace fabmap_node {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs trail_period = 1'000'000'000;

/// A pose a second, 2 m apart.
void drive(BeliefTrail& trail, StampNs from, int poses) {
  for (int i = 0; i < poses; ++i)
    trail.addOdometry({from + i * trail_period, {urban_nav_core::Quaterniond::Identity(), {2.0 * i, 0.0, 0.0}}});
}

PlaceBelief beliefAt(StampNs stamp) {
  PlaceBelief belief;
  belief.at = {"", stamp};
  belief.knowledge = PlaceKnowledge::Known;
  belief.p_new = 0.005;
  belief.likeliest = {{{"", stamp - 60 * trail_period}, 0.995}};
  return belief;
}

TEST(BeliefTrail, BeliefsAreWhereOdometryWas) {
  BeliefTrail trail;
  drive(trail, 100 * trail_period, 11);
  trail.add(beliefAt(103 * trail_period));
  trail.add(beliefAt(105 * trail_period + trail_period / 2));
  ASSERT_EQ(trail.points().size(), 2U);
  EXPECT_EQ(trail.points()[0].p_odom.x(), 6.0);
  EXPECT_EQ(trail.points()[1].p_odom.x(), 11.0);
  EXPECT_EQ(trail.points()[1].likeliest->at.stamp, 45 * trail_period + trail_period / 2);
  EXPECT_EQ(trail.find(103 * trail_period), &trail.points()[0]);
  EXPECT_EQ(trail.find(104 * trail_period), nullptr);
}

TEST(BeliefTrail, WaitsForOdometryAndLeavesOutWhatWasBeforeIt) {
  BeliefTrail trail;
  trail.add(beliefAt(90 * trail_period));
  trail.add(beliefAt(109 * trail_period));
  trail.add(beliefAt(111 * trail_period));
  EXPECT_TRUE(trail.points().empty());
  drive(trail, 100 * trail_period, 11);
  ASSERT_EQ(trail.points().size(), 1U);
  EXPECT_EQ(trail.points()[0].stamp, 109 * trail_period);
  EXPECT_EQ(trail.count(), 1U);
  drive(trail, 111 * trail_period, 1);
  EXPECT_EQ(trail.count(), 2U);
}

TEST(BeliefTrail, LeavesOutWhatIsUnusedOrStationaryAndClearsWhenTimeGoesBack) {
  BeliefTrail trail;
  drive(trail, 100 * trail_period, 11);
  PlaceBelief dark = beliefAt(101 * trail_period), stationary = beliefAt(102 * trail_period);
  dark.observation = ObservationStatus::Dark;
  stationary.is_stationary = true;
  trail.add(dark);
  trail.add(stationary);
  EXPECT_TRUE(trail.points().empty());
  trail.add(beliefAt(105 * trail_period));
  drive(trail, 50 * trail_period, 11);
  EXPECT_EQ(trail.points().size(), 1U);
  trail.add(beliefAt(55 * trail_period));
  ASSERT_EQ(trail.points().size(), 1U);
  EXPECT_EQ(trail.points()[0].p_odom.x(), 10.0);
}

TEST(BeliefTrail, ItsLengthIsBounded) {
  BeliefTrail trail;
  for (int i = 0; i < 6000; ++i) {
    drive(trail, (100 + i) * trail_period, 1);
    trail.add(beliefAt((100 + i) * trail_period));
  }
  EXPECT_EQ(trail.points().size(), 5000U);
  EXPECT_EQ(trail.points().front().stamp, 1100 * trail_period);
  EXPECT_EQ(trail.count(), 6000U);
}

}  // namespace
}  // namespace fabmap_node
