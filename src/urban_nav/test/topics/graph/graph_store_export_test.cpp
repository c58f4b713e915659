// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_store_export.hpp"

#include <gtest/gtest.h>

#include "inspect/store_info.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

/// Steps of 1 m along x.
SessionOdometry straight(int frames) {
  SessionOdometry run;
  for (int i = 0; i < frames; ++i) {
    SmoothedFrame settled;
    settled.stamp = 50'000'000LL * i;
    settled.from_previous.from = 50'000'000LL * std::max(0, i - 1);
    settled.from_previous.to = settled.stamp;
    if (i > 0) settled.from_previous.T_from_to = Pose(urban_nav_core::Quaterniond::Identity(), {1.0, 0.0, 0.0});
    settled.from_previous.covariance = 1e-4 * urban_nav_core::Matrix6d::Identity();
    settled.T_odom_base.pose = Pose(urban_nav_core::Quaterniond::Identity(), {1.0 * i, 0.0, 0.0});
    run.settled.push_back(settled);
  }
  return run;
}

urban_nav_core::MetricClosure sideways(int step) {
  urban_nav_core::ClosureRow row;
  row.a = {"monday", 50'000'000LL * step};
  row.b = {"tuesday", 50'000'000LL * step};
  row.method = urban_nav_core::ClosureMethod::Stereo;
  row.T_a_b = Pose(urban_nav_core::Quaterniond::Identity(), {0.0, 2.0, 0.0});
  row.sigma_m = 0.02;
  row.sigma_rad = 0.005;
  row.where = "closure " + std::to_string(step);
  return toMetricClosure(row);
}

constexpr const char *kMonday = "aaaaaaaaaaaaaaaa", *kTuesday = "bbbbbbbbbbbbbbbb", *kFriday = "ffffffffffffffff";

TEST(GraphRows, AStoreHoldsTheRelaxedMap) {
  const SessionOdometry monday = straight(20), tuesday = straight(20), friday = straight(20);
  const GraphRun run = runGraph({}, {&monday, &tuesday, &friday}, {"monday", "tuesday", "friday"},
                                {sideways(3), sideways(8), sideways(15)});
  ASSERT_TRUE(run.joined(1));
  const TemporaryFolder folder;
  const std::string path = folder.file("s.db");
  {
    Store store(path, Access::Write);
    for (const char* id : {kMonday, kTuesday, kFriday}) {
      store.sessions().put({id, id, "", "", 0, true});
      for (const SmoothedFrame& settled : monday.settled) {
        urban_nav_store::Node node;
        node.stamp = settled.stamp;
        node.T_odom_base = settled.T_odom_base.pose;
        store.graph().put(id, node);
      }
    }
    exportGraph(store, {kMonday, kTuesday, kFriday}, run);
    exportGraph(store, {kMonday, kTuesday, kFriday}, run);
    store.commit();
    std::size_t session = 0;
    for (const char* id : {kMonday, kTuesday, kFriday}) {
      const StoredTrajectory stored = readTrajectory(store, *store.sessions().find(id));
      const urban_nav_core::Trajectory expected = run.trajectory(session++);
      EXPECT_TRUE(stored.relaxed);
      EXPECT_EQ(stored.map, session == 3 ? kFriday : kMonday);
      ASSERT_EQ(stored.T_map_base.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(stored.T_map_base[i].pose.t(), expected[i].pose.t());
    }
    const auto anchor = store.sessions().anchor(kTuesday);
    EXPECT_NEAR(anchor->T_map_odom.t().y(), 2.0, 0.01);
  }
  const StoreInfo info = readStoreInfo(path);
  EXPECT_EQ(info.joined.size(), 2U);
  std::int64_t accepted = 0;
  for (const StoredSession& each : info.sessions)
    if (each.edges.count("stereo") > 0) accepted += each.edges.at("stereo").at("accepted");
  EXPECT_EQ(accepted, 3);
}

}  // namespace
}  // namespace urban_nav
