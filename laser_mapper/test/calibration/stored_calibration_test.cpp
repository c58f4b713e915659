// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <optional>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "laser_mapper/calibration/view_calibration.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"

namespace laser_mapper {
namespace {

using urban_nav_registration::panoramaCorrection;
using urban_nav_registration::readCalibration;

constexpr const char* kStoredSession = "0123456789abcdef0123";

CalibrationResult lateLeftLaser(double delay) {
  DeviceCalibration left, right;
  left.frame = "laser_left";
  right.frame = "laser_right";
  left.terms[0] = {delay, 0.001, true, delay};
  left.terms[4] = {0.02, 0.001, true, 0.02};
  CalibrationResult found;
  found.lasers = {left, right};
  return found;
}

/// Delayed, and rotated about a vertical axis 2 m in front of the robot.
ViewCalibration latePanorama(double delay) {
  ViewCalibration found;
  found.centre = {2.0, 0.0, 0.0};
  found.head.terms[0] = {delay, 0.001, true, delay};
  if (delay > 0.0) found.head.terms[6] = {0.01, 0.001, true, 0.01};
  return found;
}

class StoredCalibration : public ::testing::Test {
 protected:
  StoredCalibration() {
    urban_nav_store::removeStore(path_);
    store_.emplace(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kStoredSession, "drive", "", "", 1, true});
  }
  ~StoredCalibration() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  const std::string path_ = ::testing::TempDir() + "stored_calibration_test.db";
  std::optional<urban_nav_store::Store> store_;
};

TEST_F(StoredCalibration, LasersAndPanoramaDoNotOverwriteEachOtherInAnyOrder) {
  storeViewCalibration(*store_, kStoredSession, latePanorama(0.02));
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.03));
  EXPECT_EQ(panoramaCorrection(*store_, kStoredSession).delay, 20'000'000);
  ASSERT_EQ(readCalibration(*store_, kStoredSession).size(), 2U) << "the right laser is as stated";
  EXPECT_EQ(readCalibration(*store_, kStoredSession)[0].delay, 30'000'000);
  const urban_nav_core::Pose head = panoramaCorrection(*store_, kStoredSession).T_correction;
  EXPECT_LT((head * Eigen::Vector3d(2.0, 0.0, 1.0) - Eigen::Vector3d(2.0, 0.0, 1.0)).norm(), 1e-12) << "the axis";
  EXPECT_LT((head * Eigen::Vector3d(3.0, 0.0, 1.0) - Eigen::Vector3d(3.0, 0.01, 1.0)).norm(), 1e-4);
  EXPECT_NEAR(urban_nav_core::logSo3(readCalibration(*store_, kStoredSession)[0].T_stated_adopted.q()).x(), 0.02,
              1e-12);
  storeViewCalibration(*store_, kStoredSession, latePanorama(0.01));
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.04));
  ASSERT_EQ(readCalibration(*store_, kStoredSession).size(), 2U);
  EXPECT_EQ(readCalibration(*store_, kStoredSession)[0].delay, 40'000'000);
  EXPECT_EQ(panoramaCorrection(*store_, kStoredSession).delay, 10'000'000);
}

TEST_F(StoredCalibration, NothingAdoptedIsAsStated) {
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.03));
  storeViewCalibration(*store_, kStoredSession, latePanorama(0.02));
  storeCalibration(*store_, kStoredSession, {});
  ASSERT_EQ(readCalibration(*store_, kStoredSession).size(), 1U) << "the panorama's stays";
  storeViewCalibration(*store_, kStoredSession, latePanorama(0.0));
  EXPECT_TRUE(readCalibration(*store_, kStoredSession).empty());
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.03));
  forgetCalibration(*store_, kStoredSession);
  EXPECT_TRUE(readCalibration(*store_, kStoredSession).empty());
}

}  // namespace
}  // namespace laser_mapper
