// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibration_state.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

TEST(CalibrationState, ReadsBackWhatWasWritten) {
  const Pose T(urban_nav_core::expSo3(Vector3d(0.01, -0.02, 0.03)), Vector3d(0.1, 0.2, -0.3));
  const auto lasers = unpackCalibration(packCalibration({{"laser_left", 30'000'000, T}, {"laser_right", -5, Pose()}}));
  ASSERT_EQ(lasers.size(), 2U);
  EXPECT_EQ(lasers[0].frame, "laser_left");
  EXPECT_EQ(lasers[0].delay, 30'000'000);
  EXPECT_TRUE(isApprox(lasers[0].T_stated_laser, T, 1e-15));
  EXPECT_EQ(lasers[1].delay, -5);
}

TEST(CalibrationState, DamagedBytesAreRefused) {
  const std::string bytes = packCalibration({{"laser_left", 30'000'000, Pose()}});
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    EXPECT_THROW(unpackCalibration(damaged), urban_nav_core::DataError) << i;
    EXPECT_THROW(unpackCalibration(std::string_view(bytes).substr(0, i)), urban_nav_core::DataError) << i;
  }
}

}  // namespace
}  // namespace laser_mapper
