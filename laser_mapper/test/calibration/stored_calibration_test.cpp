// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <optional>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"

namespace laser_mapper {
namespace {

using urban_nav_registration::panoramaDelay;
using urban_nav_registration::readCalibration;

constexpr const char* kStoredSession = "0123456789abcdef0123";

CalibrationResult lateLeftLaser(double delay) {
  LaserCalibration left, right;
  left.frame = "laser_left";
  right.frame = "laser_right";
  left.terms[0] = {delay, 0.001, true, delay};
  left.terms[4] = {0.02, 0.001, true, 0.02};
  CalibrationResult found;
  found.lasers = {left, right};
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
  storePanoramaDelay(*store_, kStoredSession, 0.02);
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.03));
  EXPECT_EQ(panoramaDelay(*store_, kStoredSession), 20'000'000);
  ASSERT_EQ(readCalibration(*store_, kStoredSession).size(), 2U) << "the right laser is as stated";
  EXPECT_EQ(readCalibration(*store_, kStoredSession)[0].delay, 30'000'000);
  EXPECT_NEAR(urban_nav_core::logSo3(readCalibration(*store_, kStoredSession)[0].T_stated_adopted.q()).x(), 0.02,
              1e-12);
  storePanoramaDelay(*store_, kStoredSession, 0.01);
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.04));
  ASSERT_EQ(readCalibration(*store_, kStoredSession).size(), 2U);
  EXPECT_EQ(readCalibration(*store_, kStoredSession)[0].delay, 40'000'000);
  EXPECT_EQ(panoramaDelay(*store_, kStoredSession), 10'000'000);
}

TEST_F(StoredCalibration, NothingAdoptedIsAsStated) {
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.03));
  storePanoramaDelay(*store_, kStoredSession, 0.02);
  storeCalibration(*store_, kStoredSession, {});
  ASSERT_EQ(readCalibration(*store_, kStoredSession).size(), 1U) << "the panorama's stays";
  storePanoramaDelay(*store_, kStoredSession, 0.0);
  EXPECT_TRUE(readCalibration(*store_, kStoredSession).empty());
  storeCalibration(*store_, kStoredSession, lateLeftLaser(0.03));
  forgetCalibration(*store_, kStoredSession);
  EXPECT_TRUE(readCalibration(*store_, kStoredSession).empty());
}

}  // namespace
}  // namespace laser_mapper
