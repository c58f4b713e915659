// SPDX-License-Identifier: BSD-3-Clause
#include "map/previous_sessions.hpp"
#include "topics/graph/previous_closures.hpp"

#include <gtest/gtest.h>

#include "map/store_keys.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_store::Access;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Store;

Pose at(double x) { return Pose(urban_nav_core::Quaterniond::Identity(), {x, 0.0, 0.0}); }

class PreviousSessionsTest : public ::testing::Test {
 protected:
  void put(const std::string& id, const std::string& name, std::int64_t start, int nodes) {
    store.sessions().put({id, name, "", "", start, true});
    for (int i = 0; i < nodes; ++i) {
      urban_nav_store::Node node;
      node.stamp = start + i;
      node.T_odom_base = at(i);
      node.covariance = (i + 1) * Matrix6d::Identity();
      node.drift_covariance = 0.5 * Matrix6d::Identity();
      node.constants = {{"scale", 0.0, 0.0, 5e-4, i * urban_nav_core::Vector6d::Unit(0)}};
      node.status = i == 1 ? urban_nav_core::Health::Lost : urban_nav_core::Health::Ok;
      store.graph().put(id, node);
      store.inputs().append(id, {kVoStream, node.stamp, true});
    }
  }
  void tie(const std::string& a, std::int64_t stamp_a, const std::string& b, std::int64_t stamp_b, EdgeKind kind,
           double x) {
    Edge edge{{a, stamp_a},
              {b, stamp_b},
              kind,
              kind == EdgeKind::Odometry ? kVoStage : "closures.csv:7",
              {at(x), 4.0 * Matrix6d::Identity()},
              1.0,
              ClosureVerdict::Accepted,
              ""};
    store.graph().put(edge);
  }

  const urban_nav_input::testing::TemporaryFolder folder;
  Store store{folder.file("s.db"), Access::Write};
};

TEST_F(PreviousSessionsTest, BringsChainsBackToTheLastBit) {
  put("m", "monday.bag", 100, 3);
  tie("m", 100, "m", 101, EdgeKind::Odometry, 1.0 / 3.0);  // what was measured, not the difference of rounded poses
  store.inputs().append("m", {kVoStream, 104, false});
  store.sessions().put("m", urban_nav_store::Extrinsic{urban_nav_core::frames::kStereoLeft, at(0.3)});
  store.states().put("m", kForcesStage, packForces({{100, {0.0, 0.0, 9.8}}}));
  store.sessions().put(urban_nav_store::Anchor{"m", "m", 4, Pose()});
  const PreviousSessions earlier = readPreviousSessions(store, {});
  ASSERT_EQ(earlier.runs.size(), 1U);
  EXPECT_EQ(earlier.names.front(), "monday");
  EXPECT_EQ(earlier.revision, 4);
  const SessionOdometry& run = earlier.runs.front();
  ASSERT_EQ(run.settled.size(), 3U);
  EXPECT_EQ(run.settled[0].from_previous.from, run.settled[0].from_previous.to);
  EXPECT_EQ(run.settled[1].from_previous.T_from_to.t().x(), 1.0 / 3.0);
  EXPECT_EQ(run.settled[2].from_previous.T_from_to.t().x(), 1.0) << "no edge: what the poses say";
  EXPECT_EQ(run.settled[2].from_previous.covariance, 3.0 * Matrix6d::Identity());
  EXPECT_EQ(run.settled[2].from_previous.drift_covariance, 0.5 * Matrix6d::Identity());
  ASSERT_EQ(run.settled[2].from_previous.constants.size(), 1U);
  EXPECT_EQ(run.settled[2].from_previous.constants[0].sensitivity, 2.0 * urban_nav_core::Vector6d::Unit(0));
  EXPECT_EQ(run.settled[1].status.health, urban_nav_core::Health::Lost);
  ASSERT_EQ(run.frames.size(), 4U);
  EXPECT_FALSE(run.frames[3].accepted);
  EXPECT_EQ(run.T_base_camera.t().x(), 0.3);
  ASSERT_EQ(run.forces.size(), 1U);
  EXPECT_FALSE(holdsClosures(store));
}

TEST_F(PreviousSessionsTest, BringsClosuresBetweenTheSessionsThatStay) {
  put("m", "monday.bag", 100, 3);
  put("t", "monday", 200, 3);
  put("w", "", 300, 3);
  tie("m", 100, "t", 201, EdgeKind::Stereo, 2.0);
  tie("t", 200, "t", 202, EdgeKind::Asserted, 3.0);
  tie("m", 100, "w", 300, EdgeKind::Icp, 4.0);
  EXPECT_TRUE(holdsClosures(store));
  const PreviousSessions earlier = readPreviousSessions(store, {"w"});
  EXPECT_EQ(earlier.names, (std::vector<std::string>{"monday", "monday_2"}));
  const PreviousClosures closures = closuresBetween(store, earlier.ids, earlier.names);
  ASSERT_EQ(closures.offered.size(), 2U);
  ASSERT_EQ(closures.in_graph.size(), 2U);
  EXPECT_EQ(closures.in_graph[0].b.session, "monday_2");
  EXPECT_EQ(closures.offered[0].method, urban_nav_core::ClosureMethod::Stereo);
  EXPECT_EQ(closures.offered[0].measured.T_a_b.t().x(), 2.0);
  EXPECT_EQ(closures.in_graph[0].measured.information, 4.0 * Matrix6d::Identity());
  EXPECT_EQ(closures.in_graph[1].kind, EdgeKind::Asserted);
  EXPECT_EQ(readPreviousSessions(store, {}).names.back(), "w") << "a session without a name is called by its id";
  EXPECT_TRUE(readPreviousSessions(store, {"m", "t", "w"}).runs.empty());
}

}  // namespace
}  // namespace urban_nav
