// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "ghosts/chunk_beams.hpp"
#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "support/scanned_room.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;

constexpr const char* kGhostSession = "0123456789abcdef0123";
constexpr StampNs kGap = 500'000'000, kSecondVisit = 40'000'000'000;
const Vector3d kPerson(0.0, 3.0, 0.0);
constexpr double kPersonRadius = 0.3, kPersonHeight = 1.7;

/// Ends beams at a person at kPerson.
void addPerson(const Trajectory& T_map_base, std::vector<Scan>& scans) {
  for (Scan& scan : scans)
    for (urban_nav_core::Beam& beam : scan.beams) {
      const auto T_map_base_now = T_map_base.at(beam.stamp, kGap);
      if (!T_map_base_now) continue;
      const Pose T_map_laser = *T_map_base_now * testing_room::roomLaser();
      const Vector3d along = T_map_laser.q() * beam.direction.cast<double>(), from = T_map_laser.t() - kPerson;
      const double a = along.head<2>().squaredNorm(), b = along.head<2>().dot(from.head<2>());
      const double root = b * b - a * (from.head<2>().squaredNorm() - kPersonRadius * kPersonRadius);
      if (root < 0.0) continue;
      const double range = (-b - std::sqrt(root)) / a, height = from.z() + range * along.z();
      if (range > 0.0 && height < kPersonHeight && height > 0.0)
        beam.range = std::min(beam.range, static_cast<float>(range));
    }
}

/// The drive through the room, and the same drive 40 s later.
Trajectory twoVisits() {
  Trajectory twice = testing_room::driveThroughRoom(20.0);
  const Trajectory once = twice;
  for (const auto& pose : once) twice.append(pose.stamp + kSecondVisit, pose.pose);
  return twice;
}

class GhostTest : public ::testing::Test {
 protected:
  GhostTest() {
    path_ = ::testing::TempDir() + "ghosts_test.db";
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
  }
  ~GhostTest() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  void putScans(bool person_first, bool person_second) {
    store_->sessions().put(urban_nav_store::Session{kGhostSession, "room", "", "", 1, true});
    store_->sessions().put(kGhostSession, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
    const Trajectory once = testing_room::driveThroughRoom(20.0);
    for (const bool second : {false, true}) {
      std::vector<Scan> scans = testing_room::scansOfRoom(once, testing_room::roomLaser(), 0.005);
      if (second ? person_second : person_first) addPerson(once, scans);
      for (Scan& scan : scans) {
        scan.stamp += second ? kSecondVisit : 0;
        for (urban_nav_core::Beam& beam : scan.beams) beam.stamp += second ? kSecondVisit : 0;
        store_->scans().put(kGhostSession, "laser_left", scan);
      }
    }
    store_->commit();
  }

  struct Made {
    std::string bytes;
    std::size_t all = 0, on_person = 0, ghost_beams = 0;
  };
  Made makeMap(const Trajectory& trajectory, bool ghosts = true) {
    Parameters parameters;
    parameters.ghosts = ghosts;
    LaserMap map(parameters, *store_, {{kGhostSession, &trajectory, nullptr}});
    map.render();
    Made made;
    made.ghost_beams = map.forEachTile([&](const Tile&, const std::vector<MapPoint>& points) {
      for (const MapPoint& point : points) {
        appendVertex(made.bytes, point);
        ++made.all;
        const double aside = (point.p.head<2>().cast<double>() - kPerson.head<2>()).norm();
        if (aside < 0.4 && point.p.z() > 0.3F && point.p.z() < 1.8F) ++made.on_person;
      }
    });
    return made;
  }

  std::string path_;
  std::unique_ptr<Store> store_;
};

TEST_F(GhostTest, APersonPresentOnceIsRemovedAndTheRoomRemains) {
  putScans(true, false);
  const Trajectory trajectory = twoVisits();
  const Made with = makeMap(trajectory, false), without = makeMap(trajectory);
  EXPECT_GT(with.on_person, 100U);
  EXPECT_EQ(with.ghost_beams, 0U);
  EXPECT_LT(without.on_person, with.on_person / 20);
  EXPECT_GT(without.ghost_beams, with.on_person);
  EXPECT_GT(without.all + with.on_person, with.all - with.all / 500);
}

TEST_F(GhostTest, APersonArrivingBetweenTheVisitsIsRemovedToo) {
  putScans(false, true);
  const Made made = makeMap(twoVisits());
  EXPECT_LT(made.on_person, 10U);
  EXPECT_GT(made.ghost_beams, 100U);
}

TEST_F(GhostTest, APersonPresentInBothVisitsRemains) {
  putScans(true, true);
  const Made made = makeMap(twoVisits());
  EXPECT_GT(made.on_person, 100U);
  EXPECT_LT(made.ghost_beams, 20U);
}

TEST_F(GhostTest, FlagsFollowTheChunksAndDoNotDependOnThreads) {
  putScans(true, false);
  const Trajectory first = testing_room::driveThroughRoom(20.0), both = twoVisits();
  EXPECT_EQ(makeMap(first).ghost_beams, 0U) << "ghosts cannot be found in a single visit";
  std::string later, from_scratch;
  {
    const urban_nav_core::ThreadLimit limit(1);
    later = makeMap(both).bytes;
  }
  store_->sessions().clear(kGhostSession);
  store_->sessions().put(kGhostSession, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
  {
    const urban_nav_core::ThreadLimit limit(2);
    from_scratch = makeMap(both).bytes;
  }
  EXPECT_TRUE(later == from_scratch && later.size() > 1000);
  EXPECT_TRUE(makeMap(both).bytes == from_scratch) << "unchanged";
  EXPECT_GT(makeMap(first).on_person, 100U) << "the visit with beams through the point was removed";
}

TEST(ChunkBeams, DistinguishPassedFromHitPoints) {
  const Trajectory trajectory = testing_room::driveThroughRoom(8.0);  // x = -5...-1, y near 0, looking towards +y
  LaserInput laser;
  laser.T_base_laser = testing_room::roomLaser();
  laser.scans = testing_room::scansOfRoom(trajectory, testing_room::roomLaser(), 0.005);
  const ChunkBeams beams(trajectory, {laser}, kGap);
  EXPECT_EQ(beams.look({-3.0, 3.0, 1.2}), Sight::Through);
  EXPECT_EQ(beams.look({-3.0, 6.02, 1.2}), Sight::Hit);
  EXPECT_EQ(beams.look({-3.0, 7.0, 1.2}), Sight::None) << "within the wall";
  EXPECT_EQ(beams.look({-3.0, -3.0, 1.2}), Sight::None) << "on the other side of the robot";
  EXPECT_EQ(beams.look({3.0, 3.0, 1.2}), Sight::None) << "where the person was not";
  for (double y = 1.5; y < 5.9; y += 0.1) EXPECT_EQ(beams.look({-3.0, y, 0.0}), Sight::Hit) << "floor at " << y;
  EXPECT_GT(beams.bytes(), 100'000U);
}

}  // namespace
}  // namespace laser_mapper
