// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {

constexpr urban_nav_core::StampNs kExportStart = 1'225'719'872'000'000'000;
constexpr const char* kExportSession = "0123456789abcdef0123";

/// A store of a drive of 8 m along x beside a wall at y = 4; the laser looks to the left from 1 m above the ground.
class MapExportTest : public ::testing::Test {
 protected:
  MapExportTest() : store_(folder_.file("session.db"), urban_nav_store::Access::Write) {
    store_.sessions().put(urban_nav_store::Session{kExportSession, "wall", "", "", 1, true});
    Eigen::Matrix3d R;
    R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    store_.sessions().put(kExportSession,
                          urban_nav_store::Extrinsic{urban_nav_core::frames::kLaserLeft,
                                                     urban_nav_core::Pose(R, urban_nav_core::Vector3d(0.0, 0.0, 1.0))});
    for (int i = 0; i <= 160; ++i) {
      urban_nav_store::Node node;
      node.stamp = kExportStart + i * 50'000'000LL;
      node.T_odom_base = urban_nav_core::Pose(R.Identity(), urban_nav_core::Vector3d(0.05 * i, 0.0, 0.0));
      store_.graph().put(kExportSession, node);
      if (i > 0 && i < 160) store_.scans().put(kExportSession, urban_nav_core::frames::kLaserLeft, scan(node.stamp));
    }
    store_.commit();
  }

  static urban_nav_core::Scan scan(urban_nav_core::StampNs stamp) {
    urban_nav_core::Scan scan;
    scan.stamp = stamp;
    for (int degrees = -45; degrees <= 40; ++degrees) {
      const double angle = degrees * M_PI / 180.0;
      urban_nav_core::Beam beam;
      beam.stamp = stamp;
      beam.direction = urban_nav_core::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
      const double wall = 4.0 / std::cos(angle), ground = angle < 0.0 ? 1.0 / std::sin(-angle) : 1e9;
      beam.range = static_cast<float>(std::min(wall, ground));
      scan.beams.push_back(beam);
    }
    return scan;
  }

  std::vector<urban_nav_store::StoredTrajectory> map() {
    return urban_nav_store::readMaps(store_, urban_nav_store::selectSessions(store_, {})).front();
  }
  void render() {
    const urban_nav_core::Trajectory trajectory(map().front().T_map_base);
    laser_mapper::LaserMap(laser_mapper::Parameters(), store_, {{kExportSession, &trajectory, nullptr}}).render();
  }

  urban_nav_input::testing::TemporaryFolder folder_;
  urban_nav_store::Store store_;
};

}  // namespace urban_nav
