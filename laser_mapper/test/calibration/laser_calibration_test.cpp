// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/calibration/laser_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "support/scanned_room.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {
namespace {

using testing_room::kRoomStart;
using urban_nav_core::Pose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;

constexpr const char* kDrive = "0123456789abcdef0123";
constexpr double kDegree = M_PI / 180.0;

double smoothStep(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// Around the room, 12 m by 5 m, in 20 s, a turn on the spot, and around it in the opposite direction, in 44 s; with
/// the speed and heading variations of manual driving.
Trajectory roundTheRoom() {
  Trajectory trajectory;
  for (int i = 0; i <= 880; ++i) {
    const double t = 0.05 * i, phase = 2.0 * M_PI * (smoothStep(t / 20.0) - smoothStep((t - 24.0) / 20.0));
    const double heading = std::atan2(2.5 * std::cos(phase), -6.0 * std::sin(phase)) +
                           M_PI * smoothStep((t - 20.0) / 4.0) + 0.05 * std::sin(1.7 * t);
    trajectory.append(kRoomStart + static_cast<StampNs>(i) * 50'000'000,
                      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(heading, Vector3d::UnitZ())),
                           Vector3d(6.0 * std::cos(phase), 2.5 * std::sin(phase), 0.0)));
  }
  return trajectory;
}

/// Straight along the room.
Trajectory straightThroughRoom() {
  Trajectory trajectory;
  for (int i = 0; i <= 300; ++i)
    trajectory.append(kRoomStart + static_cast<StampNs>(i) * 50'000'000,
                      Pose(Eigen::Quaterniond::Identity(), Vector3d(-7.5 + 0.05 * i, 0.4, 0.0)));
  return trajectory;
}

Pose rightLaser() {
  Eigen::Matrix3d R;
  R.col(0) = -Vector3d::UnitY();
  R.col(1) = -Vector3d::UnitZ();
  R.col(2) = Vector3d::UnitX();
  return Pose(R, Vector3d(0.0, -0.25, 0.9));
}

/// Store of a drive through the room with a known calibration error.
class LaserCalibrationTest : public ::testing::Test {
 protected:
  LaserCalibrationTest() {
    path_ = ::testing::TempDir() + "laser_calibration_test.db";
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kDrive, "room", "", "", 1, true});
  }
  ~LaserCalibrationTest() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  /// Adds the scans of a laser. Its stamps are late by `delay`, and its extrinsics are rotated by `turn`.
  void scanWith(const std::string& frame, const Pose& T_base_laser, const Trajectory& trajectory, StampNs delay,
                const Vector3d& turn) {
    for (Scan scan : testing_room::scansOfRoom(trajectory, T_base_laser, 0.005)) {
      scan.stamp += delay;
      for (urban_nav_core::Beam& beam : scan.beams) beam.stamp += delay;
      store_->scans().put(kDrive, frame, scan);
    }
    store_->sessions().put(
        kDrive, urban_nav_store::Extrinsic{frame, T_base_laser * Pose(urban_nav_core::expSo3(turn), Vector3d::Zero())});
    store_->commit();
  }

  CalibrationResult calibrate(const Trajectory& trajectory) {
    return calibrateLasers(Parameters(), *store_, kDrive, trajectory, nullptr);
  }

  std::string mapBytes(const Trajectory& trajectory) {
    LaserMap map(Parameters(), *store_, {{kDrive, &trajectory, nullptr}});
    map.render();
    std::string bytes;
    map.forEachTile([&](const Tile&, const std::vector<MapPoint>& points) {
      for (const MapPoint& point : points) appendVertex(bytes, point);
    });
    return bytes;
  }

  std::string path_;
  std::unique_ptr<Store> store_;
};

/// Returns the share of a map's points within 2 cm of the room's surfaces.
double shareOnSurfaces(Store& store, const Trajectory& trajectory) {
  LaserMap map(Parameters(), store, {{kDrive, &trajectory, nullptr}});
  map.render();
  std::size_t near = 0, all = 0;
  map.forEachTile([&](const Tile&, const std::vector<MapPoint>& points) {
    all += points.size();
    for (const MapPoint& point : points) near += testing_room::distanceToRoom(point.p.cast<double>()) < 0.02 ? 1 : 0;
  });
  return static_cast<double>(near) / static_cast<double>(all);
}

TEST_F(LaserCalibrationTest, ALateAndTurnedLaserIsFoundAndTheMapIsSharp) {
  const Trajectory trajectory = roundTheRoom();
  const Vector3d turn = Vector3d(0.3, 1.0, -0.5) * kDegree;
  scanWith("laser_left", testing_room::roomLaser(), trajectory, 30'000'000, Vector3d::Zero());
  scanWith("laser_right", rightLaser(), trajectory, 0, turn);
  const CalibrationResult found = calibrate(trajectory);
  ASSERT_EQ(found.lasers.size(), 2U);
  EXPECT_TRUE(found.isAdopted());
  EXPECT_LT(found.calibrated_spread, 0.3 * found.stated_spread);
  const DeviceCalibration &left = found.lasers[0], &right = found.lasers[1];
  EXPECT_NEAR(left.at(CalibrationTerm::Delay).adopted, 0.030, 0.001);
  EXPECT_NEAR(right.at(CalibrationTerm::Delay).value, 0.0, 0.001);
  for (int axis = 0; axis < 3; ++axis) {
    const CalibrationEstimate& term = right.terms[static_cast<std::size_t>(4 + axis)];
    EXPECT_NEAR(term.adopted, -turn(axis), 0.05 * kDegree) << "axis " << axis;
    EXPECT_LT(std::abs(term.adopted + turn(axis)), 4.0 * term.sigma) << "axis " << axis;
  }
  const double before = shareOnSurfaces(*store_, trajectory);
  storeCalibration(*store_, kDrive, found);
  EXPECT_GT(shareOnSurfaces(*store_, trajectory), 0.97);
  EXPECT_LT(before, 0.8);
}

TEST_F(LaserCalibrationTest, WhereNothingIsWrongNothingChanges) {
  const Trajectory trajectory = roundTheRoom();
  scanWith("laser_left", testing_room::roomLaser(), trajectory, 0, Vector3d::Zero());
  scanWith("laser_right", rightLaser(), trajectory, 0, Vector3d::Zero());
  const std::string before = mapBytes(trajectory);
  const CalibrationResult found = calibrate(trajectory);
  EXPECT_FALSE(found.isAdopted());
  for (const DeviceCalibration& laser : found.lasers)
    for (const CalibrationEstimate& term : laser.terms) {
      EXPECT_LE(std::abs(term.value), 3.0 * term.sigma);
      EXPECT_EQ(term.adopted, 0.0);
    }
  storeCalibration(*store_, kDrive, found);
  EXPECT_TRUE(mapBytes(trajectory) == before);
}

TEST_F(LaserCalibrationTest, OnTheLevelTheHeightOfALaserIsNotConstrained) {
  const Trajectory trajectory = roundTheRoom();
  scanWith("laser_left", testing_room::roomLaser(), trajectory, 0, Vector3d::Zero());
  const CalibrationResult found = calibrate(trajectory);
  ASSERT_EQ(found.lasers.size(), 1U);
  EXPECT_FALSE(found.lasers[0].at(CalibrationTerm::ShiftY).constrained);  // its y axis points up
  EXPECT_TRUE(found.lasers[0].at(CalibrationTerm::Delay).constrained);
  EXPECT_TRUE(std::any_of(found.unconstrained.begin(), found.unconstrained.end(), [](const std::string& text) {
    return text.rfind("shift of laser_left along its y axis (up)", 0) == 0;
  }));
}

TEST_F(LaserCalibrationTest, OnAStraightNothingIsFoundAndTheDelayIsNamed) {
  const Trajectory trajectory = straightThroughRoom();
  scanWith("laser_left", testing_room::roomLaser(), trajectory, 30'000'000, Vector3d::Zero());
  scanWith("laser_right", rightLaser(), trajectory, 0, Vector3d(0.0, kDegree, 0.0));
  const CalibrationResult found = calibrate(trajectory);
  EXPECT_FALSE(found.isAdopted());
  for (const DeviceCalibration& laser : found.lasers) EXPECT_FALSE(laser.at(CalibrationTerm::Delay).constrained);
  EXPECT_TRUE(std::any_of(found.unconstrained.begin(), found.unconstrained.end(),
                          [](const std::string& text) { return text.rfind("delay of laser_left", 0) == 0; }));
}

TEST_F(LaserCalibrationTest, NumbersDoNotDependOnTheNumberOfThreads) {
  const Trajectory trajectory = roundTheRoom();
  scanWith("laser_left", testing_room::roomLaser(), trajectory, 10'000'000, Vector3d::Zero());
  std::vector<CalibrationResult> results;
  for (const int threads : {1, 2}) {
    const urban_nav_core::ThreadLimit limit(threads);
    results.push_back(calibrate(trajectory));
  }
  for (std::size_t i = 0; i < kCalibrationTerms; ++i) {
    EXPECT_EQ(results[0].lasers[0].terms[i].value, results[1].lasers[0].terms[i].value);
    EXPECT_EQ(results[0].lasers[0].terms[i].sigma, results[1].lasers[0].terms[i].sigma);
  }
}

TEST_F(LaserCalibrationTest, WithoutLasersOrPathThereIsNothing) {
  EXPECT_TRUE(calibrate(roundTheRoom()).lasers.empty());
  scanWith("laser_left", testing_room::roomLaser(), roundTheRoom(), 0, Vector3d::Zero());
  EXPECT_FALSE(calibrate(Trajectory()).isAdopted());
}

}  // namespace
}  // namespace laser_mapper
