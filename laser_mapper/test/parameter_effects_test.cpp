// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <cmath>
#include <filesystem>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "support/scanned_room.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/near_points.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Access;
using urban_nav_store::NearPoints;
using urban_nav_store::Store;

constexpr const char* kEffectSession = "0123456789abcdef0123";
constexpr StampNs kLater = 30'000'000'000;
constexpr double kDriveTime = 6.0;  // s

/// Drive through the room, and the same drive 30 s later; with a gap of 0.3 s without poses.
Trajectory twoDrives() {
  Trajectory both;
  for (const StampNs later : {StampNs{0}, kLater})
    for (const auto& pose : testing_room::driveThroughRoom(kDriveTime)) {
      const double t = urban_nav_core::secondsBetween(testing_room::kRoomStart, pose.stamp);
      if (later == 0 && t > 2.0 && t < 2.3) continue;
      both.append(pose.stamp + later, pose.pose);
    }
  return both;
}

/// In the first drive there is a board of 0.5 m, 1 m before the wall; beams at its edges end between both.
void addBoard(Scan& scan) {
  const double t = urban_nav_core::secondsBetween(testing_room::kRoomStart, scan.stamp);
  if (t < 3.0 || t > 4.0) return;
  for (std::size_t i = 85; i < 95; ++i) scan.beams[i].range -= i == 85 || i == 94 ? 0.3F : 1.0F;
}

/// Points of dense stereo on the floor to the right, where no laser measures.
NearPoints floorPoints(StampNs stamp) {
  std::vector<NearPoints::Point> points;
  for (float x = 1.0F; x < 3.0F; x += 0.06F)
    for (float y = -2.0F; y < 0.0F; y += 0.06F) points.push_back({{x, y, 0.0F}, 0.02F, 90});
  NearPoints row;
  row.session = kEffectSession;
  row.stamp = stamp;
  row.camera = {0.3, 0.1, 1.1};
  row.pixel_angle = 0.002;
  row.packed = NearPoints::pack(points);
  return row;
}

/// Maps two drives through a room; each run begins with a copy of the same store.
class RoomMap {
 public:
  RoomMap() {
    urban_nav_store::removeStore(recorded_);
    Store store(recorded_, Access::Write);
    store.sessions().put(urban_nav_store::Session{kEffectSession, "room", "", "", 1, true});
    store.sessions().put(kEffectSession, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
    const Trajectory once = testing_room::driveThroughRoom(kDriveTime);
    for (const StampNs later : {StampNs{0}, kLater})
      for (Scan scan : testing_room::scansOfRoom(once, testing_room::roomLaser(), 0.005)) {
        if (later == 0) addBoard(scan);
        scan.stamp += later;
        for (urban_nav_core::Beam& beam : scan.beams) beam.stamp += later;
        store.scans().put(kEffectSession, "laser_left", scan);
      }
    for (std::size_t i = 0; i < drives_.size(); i += 20)
      urban_nav_store::TableStore<NearPoints>(store).put(floorPoints(drives_[i].stamp));
    store.commit();
  }
  ~RoomMap() {
    for (const std::string& path : {recorded_, mapped_}) urban_nav_store::removeStore(path);
  }

  std::string map(const Parameters& parameters) const {
    const std::unique_ptr<Store> store = copyStore();
    return render(parameters, *store, drives_);
  }
  /// Renders the map again after all poses moved by 2 cm.
  std::string mapTwice(const Parameters& parameters) const {
    const std::unique_ptr<Store> store = copyStore();
    render(parameters, *store, drives_);
    Trajectory moved;
    for (const auto& pose : drives_)
      moved.append(pose.stamp, Pose(pose.pose.q(), pose.pose.t() + Vector3d(0.02, 0.0, 0.0)));
    return render(parameters, *store, moved);
  }

 private:
  std::unique_ptr<Store> copyStore() const {
    urban_nav_store::removeStore(mapped_);
    std::filesystem::copy_file(recorded_, mapped_);
    return std::make_unique<Store>(mapped_, Access::Write);
  }
  static std::string render(const Parameters& parameters, Store& store, const Trajectory& drives) {
    LaserMap map(parameters, store, {{kEffectSession, &drives, nullptr}});
    map.render();
    std::string bytes;
    map.forEachTile([&](const Tile&, const std::vector<MapPoint>& points) {
      for (const MapPoint& point : points) appendVertex(bytes, point);
    });
    return bytes;
  }

  const Trajectory drives_ = twoDrives();
  const std::string recorded_ = ::testing::TempDir() + "laser_effects.db", mapped_ = recorded_ + ".map";
};

TEST(ParameterEffects, EachParameterChangesTheMap) {
  const RoomMap room;
  const auto map = [&room](const Parameters& parameters) { return room.map(parameters); };
  const auto map_twice = [&room](const Parameters& parameters) { return room.mapTwice(parameters); };
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      table(),
      {{"two drives through a room",
        map,
        {{"voxel", 0.1},
         {"min_range", 3.0},
         {"max_range", 5.0},
         {"range_sigma", 0.02},
         {"range_bias", 0.02},
         {"beam_width", 0.1},
         {"mixed_pixels", false},
         {"ghosts", false},
         {"ghost_gap", 100.0},
         {"stereo", false},
         {"stereo_sigma", 0.01},
         {"max_gap", 0.1}}},
       {"poses that moved", map_twice, {{"max_shift", 0.1}}}},
      {{"depth_sigma", "SensorsMap.ALargerErrorOfADepthCameraIsInThePoints"},
       {"constraints", "GraphPlanesTest.AreSearchedInTheScansUnlessSwitchedOff", "../src/urban_nav/test"}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace laser_mapper
