// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav_sim {
namespace {

namespace frames = urban_nav_core::frames;

TEST(SensorPlaces, OfRawImagesAreTurnedIntoTheRectifiedOnesByTheirCalibration) {
  SessionOptions rectified, raw;
  rectified.duration = raw.duration = 1.0;
  rectified.sensors = raw.sensors = {Sensor::Stereo};
  raw.defects.switchOn("stereo:lens");
  const Session of_rectified(rectified), of_raw(raw);
  const auto straight = of_rectified.places(), mounted = of_raw.places();
  for (const auto& [frame, side] : {std::pair(frames::kStereoLeft, Side::Left), {frames::kStereoRight, Side::Right}}) {
    const Eigen::Matrix3d R_rectified_raw = of_raw.stereoInfo(side).R;
    EXPECT_LT((mounted.at(frame).R() * R_rectified_raw.transpose() - straight.at(frame).R()).norm(), 1e-12) << frame;
    EXPECT_GT((mounted.at(frame).R() - straight.at(frame).R()).norm(), 1e-3) << frame;
    EXPECT_EQ(mounted.at(frame).t(), straight.at(frame).t());
  }
  EXPECT_TRUE(of_rectified.stereoInfo(Side::Left).R.isZero() || of_rectified.stereoInfo(Side::Left).R.isIdentity());
  EXPECT_EQ(mounted.at(frames::kImu).t(), straight.at(frames::kImu).t());
}

}  // namespace
}  // namespace urban_nav_sim
