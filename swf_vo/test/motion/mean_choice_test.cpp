// SPDX-License-Identifier: BSD-3-Clause
#include "motion/mean_choice.hpp"

#include <gtest/gtest.h>

namespace swf_vo {
namespace {

using Eigen::Vector3d;
using urban_nav_core::expSo3;
using urban_nav_core::isApprox;
using urban_nav_core::Pose;

const Pose kMeasured(expSo3(Vector3d(0.0, 0.0, 0.1)), Vector3d(1.0, 0.0, 0.0));

Pose offBy(double turn, double shift) {
  return Pose(expSo3(Vector3d(0.0, 0.0, 0.1 + turn)), Vector3d(1.0 + shift, 0.0, 0.0));
}

TEST(MeanChoice, WithoutEvidenceTheVelocityContinues) {
  const Pose mean = MeanChoice().choose(offBy(0.0, 0.0), offBy(0.01, 0.02));
  EXPECT_TRUE(isApprox(mean, offBy(0.0, 0.0), 1e-12));
}

TEST(MeanChoice, EachPartIsThatWhichWasNearer) {
  MeanChoice choice;
  const Pose steady = offBy(0.02, 0.001), by_sensors = offBy(0.001, 0.02);  // a gyroscope, and slipping wheels
  choice.see(steady, by_sensors, kMeasured);
  EXPECT_TRUE(isApprox(choice.choose(steady, by_sensors), offBy(0.001, 0.001), 1e-12));
  EXPECT_TRUE(isApprox(choice.choose(by_sensors, steady), offBy(0.02, 0.02), 1e-12)) << "by part, not by size";
}

TEST(MeanChoice, FollowsAChangeOverTenFramesOrSo) {
  MeanChoice choice;
  for (int i = 0; i < 1000; ++i) choice.see(offBy(0.0, 0.001), offBy(0.0, 0.01), kMeasured);
  int frames = 0;
  for (; choice.choose(offBy(0.0, 1.0), offBy(0.0, 2.0)).t().x() < 2.5 && frames < 100; ++frames)
    choice.see(offBy(0.0, 0.01), offBy(0.0, 0.001), kMeasured);
  EXPECT_GT(frames, 3);
  EXPECT_LT(frames, 20);
}

}  // namespace
}  // namespace swf_vo
