// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "support/circle_drive.hpp"
#include "topics/graph/graph_run.hpp"
#include "topics/graph/graph_store_export.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav::testing {

constexpr const char *kMondayId = "aaaaaaaaaaaaaaaa", *kTuesdayId = "bbbbbbbbbbbbbbbb";

constexpr urban_nav_core::StampNs kDay = 86'400'000'000'000;

/// Writes the odometry of a session as `map` does.
inline void putSession(urban_nav_store::Store& store, const std::string& id, const std::string& name,
                       const SessionOdometry& run) {
  store.sessions().put({id, name, "", "", run.settled.front().stamp, true});
  for (std::size_t i = 0; i < run.settled.size(); ++i) {
    const SmoothedFrame& settled = run.settled[i];
    urban_nav_store::Node node;
    node.stamp = settled.stamp;
    node.T_odom_base = settled.T_odom_base.pose;
    node.covariance_from_first = settled.T_odom_base.covariance;
    if (i > 0) {
      node.covariance = settled.from_previous.covariance;
      node.drift_covariance = settled.from_previous.drift_covariance;
      urban_nav_store::Edge step;
      step.a = {id, settled.from_previous.from};
      step.b = {id, settled.stamp};
      step.source = "swf_vo";
      step.measured.T_a_b = settled.from_previous.T_from_to;
      step.measured.information =
          urban_nav_core::invertPositiveDefinite(node.covariance).value_or(urban_nav_core::Matrix6d::Zero());
      store.graph().put(step);
    }
    store.graph().put(id, node);
  }
}

/// A store of two drives on a circle, relaxed with closures between them and within the first.
inline void writeCircleStore(const std::string& path) {
  const SessionOdometry monday = driveCircle(0, 900, 2e-4);
  SessionOdometry tuesday = driveCircle(300, 700, -1e-4);
  for (SmoothedFrame& settled : tuesday.settled)
    for (urban_nav_core::StampNs* stamp : {&settled.stamp, &settled.from_previous.from, &settled.from_previous.to})
      *stamp += kDay;
  std::vector<urban_nav_core::MetricClosure> closures;
  for (int i = 20; i < 300; i += 40) closures.push_back(closure("monday", i, "monday", i + 600));
  for (int i = 310; i < 600; i += 60) {
    closures.push_back(closure("monday", i, "tuesday", i));
    closures.back().b.stamp += kDay;
  }
  const GraphRun run = runGraph({}, {&monday, &tuesday}, {"monday", "tuesday"}, closures);
  urban_nav_store::Store store(path, urban_nav_store::Access::Write);
  putSession(store, kMondayId, "monday", monday);
  putSession(store, kTuesdayId, "tuesday", tuesday);
  exportGraph(store, {kMondayId, kTuesdayId}, run);
  store.commit();
}

}  // namespace urban_nav::testing
