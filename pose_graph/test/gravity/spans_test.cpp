// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/spans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pose_graph {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

constexpr StampNs kMs = 1'000'000;

TEST(ForcesAt, AreMeansOfForcesAroundEachStamp) {
  std::vector<SpecificForce> samples;
  for (StampNs t = 0; t < 400; t += 10) samples.push_back({t * kMs, {static_cast<double>(t), 0.0, 1.0}});
  const std::vector<StampNs> stamps = {100 * kMs, 150 * kMs, 200 * kMs, 2000 * kMs};
  const std::vector<SpecificForce> forces = forcesAt(stamps, samples);
  ASSERT_EQ(forces.size(), 3U) << "nothing around the last one";
  EXPECT_EQ(forces[1].stamp, 150 * kMs);
  EXPECT_NEAR(forces[1].force.x(), 150.0, 1e-9) << "130...170";
  EXPECT_NEAR(forces[2].force.x(), 235.0, 1e-9) << "180...290: no further than 0.1 s";
  std::reverse(samples.begin(), samples.end());
  samples.push_back({155 * kMs, Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())});
  samples.push_back({155 * kMs, Vector3d::Constant(1e6)});
  const std::vector<SpecificForce> same = forcesAt(stamps, samples);
  for (std::size_t i = 0; i < forces.size(); ++i) EXPECT_EQ(same[i].force, forces[i].force);
  EXPECT_TRUE(forcesAt({}, samples).empty());
  EXPECT_TRUE(forcesAt(stamps, {}).empty());
}

TEST(Spans, TakeTheAccelerationOfTheTrajectoryAway) {
  Trajectory trajectory;
  std::vector<SpecificForce> forces;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.05 * i;
    trajectory.append(50 * kMs * i, Pose(Eigen::Quaterniond::Identity(), {0.35 * t * t, 0.0, 0.0}));
    forces.push_back({50 * kMs * i, {0.7, 0.0, 9.81}});
  }
  const std::vector<Span> spans = makeSpans(trajectory, forces, Pose());
  ASSERT_EQ(spans.size(), 2U);
  for (const Span& span : spans) {
    EXPECT_LT((span.force - Vector3d(0.0, 0.0, 9.81)).norm(), 1e-9);
    EXPECT_LT((span.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  }
  forces.erase(forces.begin() + 30, forces.begin() + 40);
  EXPECT_EQ(makeSpans(trajectory, forces, Pose()).size(), 1U) << "none over a gap";
}

}  // namespace
}  // namespace pose_graph
