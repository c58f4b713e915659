// SPDX-License-Identifier: BSD-3-Clause
#include "lidar/sweep_view.hpp"

#include <gtest/gtest.h>

#include "support/lidar_sweeps.hpp"

namespace laser_mapper {
namespace {

using testing_room::driveThroughRoom;
using testing_room::sweepOfScene;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

class SweepViews : public ::testing::Test {
 protected:
  SweepView viewAt(urban_nav_core::StampNs reference) const {
    return {testing_room::toRings(sweepOfScene(testing_room::rangeInRoom, trajectory_, reference)), trajectory_,
            testing_room::roomLidar(), Pose(), 500'000'000};
  }
  const urban_nav_core::Trajectory trajectory_ = driveThroughRoom(4.0, 3.0);
  const urban_nav_core::StampNs middle_ = testing_room::kRoomStart + 2'000'000'000;
};

TEST_F(SweepViews, PassThroughTheAirAndHitTheWalls) {
  const SweepView view = viewAt(middle_);
  std::size_t hits = 0, walls = 0;
  for (double y = -5.0; y < 5.0; y += 0.25)
    for (double z = 0.5; z < 1.8; z += 0.25) {
      ++walls;
      hits += view.classify({10.0, y, z}) == Sight::Hit ? 1 : 0;
      EXPECT_NE(view.classify({10.0, y, z}), Sight::Through);
      EXPECT_NE(view.classify({10.6, y, z}), Sight::Through) << "beyond the wall";
    }
  EXPECT_GT(hits, walls * 9 / 10);
  EXPECT_EQ(view.classify({6.0, 1.0, 1.0}), Sight::Through);
  EXPECT_EQ(view.classify({3.0, -3.0, 0.8}), Sight::Through);
}

TEST_F(SweepViews, NeverPassThroughTheFloorAtGrazingAngles) {
  const SweepView view = viewAt(middle_);
  for (double x = -9.5; x < 9.5; x += 0.1)
    for (double y = -5.5; y < 5.5; y += 0.1) ASSERT_NE(view.classify({x, y, 0.0}), Sight::Through) << x << " " << y;
}

TEST_F(SweepViews, AreEmptyWithoutAPoseOrRings) {
  EXPECT_EQ(viewAt(testing_room::kRoomStart - 2'000'000'000).classify({6.0, 1.0, 1.0}), Sight::None);
  EXPECT_EQ(SweepView({}, trajectory_, Pose(), Pose(), 500'000'000).classify({6.0, 1.0, 1.0}), Sight::None);
  // Beams of all elevations in one ring, as for a scanner without rings.
  urban_nav_core::Scan all;
  for (const urban_nav_core::Scan& ring :
       testing_room::toRings(sweepOfScene(testing_room::rangeInRoom, trajectory_, middle_)))
    all.beams.insert(all.beams.end(), ring.beams.begin(), ring.beams.end());
  EXPECT_EQ(
      SweepView({all, all}, trajectory_, testing_room::roomLidar(), Pose(), 500'000'000).classify({6.0, 1.0, 1.0}),
      Sight::None);
}

}  // namespace
}  // namespace laser_mapper
