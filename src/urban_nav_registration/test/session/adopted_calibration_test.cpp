// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/adopted_calibration.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;

constexpr const char* kCalibratedSession = "0123456789abcdef0123";
constexpr StampNs kFirstScan = 1'225'719'872'000'000'000, kLate = 30'000'000;

Pose smallMotion() { return Pose(urban_nav_core::expSo3(Vector3d(0.01, -0.02, 0.03)), Vector3d(0.1, 0.2, -0.3)); }

TEST(AdoptedCalibrationState, ReadsBackWhatWasWritten) {
  const auto devices =
      unpackCalibration(packCalibration({{"laser_left", kLate, smallMotion()}, {"laser_right", -5, Pose()}}));
  ASSERT_EQ(devices.size(), 2U);
  EXPECT_EQ(devices[0].frame, "laser_left");
  EXPECT_EQ(devices[0].delay, kLate);
  EXPECT_TRUE(isApprox(devices[0].T_stated_adopted, smallMotion(), 1e-15));
  EXPECT_EQ(devices[1].delay, -5);
}

TEST(AdoptedCalibrationState, DamagedBytesAreRefused) {
  const std::string bytes = packCalibration({{"laser_left", kLate, Pose()}});
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    EXPECT_THROW(unpackCalibration(damaged), urban_nav_core::DataError) << i;
    EXPECT_THROW(unpackCalibration(std::string_view(bytes).substr(0, i)), urban_nav_core::DataError) << i;
  }
}

/// A session with scans of one beam every 100 ms of two lasers.
class CalibratedSession : public ::testing::Test {
 protected:
  CalibratedSession() {
    urban_nav_store::removeStore(path_);
    store_.emplace(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kCalibratedSession, "drive", "", "", kFirstScan, true});
    for (const char* frame : {"laser_left", "laser_right"}) {
      store_->sessions().put(kCalibratedSession, urban_nav_store::Extrinsic{frame, mounting()});
      for (int i = 0; i < 20; ++i) {
        Scan scan;
        scan.stamp = kFirstScan + i * 100'000'000LL;
        scan.beams.emplace_back();
        scan.beams.back().stamp = scan.stamp + 5'000'000;
        scan.beams.back().range = 1.0F;
        store_->scans().put(kCalibratedSession, frame, scan);
      }
    }
  }
  ~CalibratedSession() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }
  static Pose mounting() { return Pose(Eigen::Quaterniond::Identity(), Vector3d(0.3, 0.2, 1.0)); }
  std::vector<Scan> scansOfLaser(std::size_t laser, StampNs from, StampNs to) {
    std::vector<Scan> scans;
    const auto lasers = storedLasers(*store_, kCalibratedSession);
    storedScans(store_->scans(), kCalibratedSession, lasers).at(laser).forEach(from, to, [&](const Scan& scan) {
      scans.push_back(scan);
    });
    return scans;
  }

  const std::string path_ = ::testing::TempDir() + "adopted_calibration_test.db";
  std::optional<Store> store_;
};

TEST_F(CalibratedSession, WithoutACalibrationLasersAreAsStated) {
  ASSERT_EQ(storedLasers(*store_, kCalibratedSession).size(), 2U);
  EXPECT_TRUE(isApprox(storedLasers(*store_, kCalibratedSession)[0].T_base_laser, mounting(), 0.0));
  EXPECT_EQ(scansOfLaser(0, kFirstScan, kFirstScan + 500'000'000).size(), 6U);
  EXPECT_EQ(panoramaCorrection(*store_, kCalibratedSession).delay, 0);
  EXPECT_TRUE(isApprox(panoramaCorrection(*store_, kCalibratedSession).T_correction, Pose(), 0.0));
}

TEST_F(CalibratedSession, AdoptedMountingAndDelayAreThoseOfStoredLasersAndScans) {
  writeCalibration(*store_, kCalibratedSession,
                   {{"laser_right", kLate, smallMotion()}, {kPanoramaDevice, 20, smallMotion()}});
  const auto lasers = storedLasers(*store_, kCalibratedSession), stated = statedLasers(*store_, kCalibratedSession);
  ASSERT_EQ(lasers.size(), 2U);
  EXPECT_TRUE(isApprox(lasers[0].T_base_laser, mounting(), 0.0));
  EXPECT_TRUE(isApprox(lasers[1].T_base_laser, mounting() * smallMotion(), 1e-12));
  EXPECT_TRUE(isApprox(stated[1].T_base_laser, mounting(), 0.0));
  EXPECT_EQ(panoramaCorrection(*store_, kCalibratedSession).delay, 20);
  EXPECT_TRUE(isApprox(panoramaCorrection(*store_, kCalibratedSession).T_correction, smallMotion(), 1e-12));
  // Scans whose true times are in the interval, with these times.
  const auto scans = scansOfLaser(1, kFirstScan, kFirstScan + 500'000'000);
  ASSERT_EQ(scans.size(), 5U);
  EXPECT_EQ(scans.front().stamp, kFirstScan + 100'000'000 - kLate);
  EXPECT_EQ(scans.front().beams[0].stamp, kFirstScan + 105'000'000 - kLate);
  EXPECT_EQ(scansOfLaser(0, kFirstScan, kFirstScan + 500'000'000).size(), 6U) << "the other laser is on time";
  writeCalibration(*store_, kCalibratedSession, {});
  EXPECT_EQ(storedLasers(*store_, kCalibratedSession)[1].delay, 0);
}

}  // namespace
}  // namespace urban_nav_registration
