// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/shared_clouds.hpp"

#include <gtest/gtest.h>

#include "support/line_surroundings.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

/// A metre a second, 200 m along a line; clouds reach 10 m to both sides.
class SharedClouds : public ::testing::Test {
 protected:
  SharedClouds() {
    std::vector<Pose> poses;
    for (int i = 0; i <= 200; ++i) poses.emplace_back(Eigen::Quaterniond::Identity(), Eigen::Vector3d(i, 0.0, 0.0));
    around_.drive("day", poses, 0.01, 0.001);
    parameters_.cloud_way = 10.0;
  }
  void add(int a, int b, ClosureMethod method = ClosureMethod::Icp, ClosureVerdict verdict = ClosureVerdict::Accepted) {
    MetricClosure made;
    made.a = {"day", a * StampNs{1'000'000'000}};
    made.b = {"day", b * StampNs{1'000'000'000}};
    made.method = method;
    made.verdict = verdict;
    made.measured.information = Matrix6d::Identity();
    closures_.push_back(made);
  }
  /// By how much what each one knows was divided.
  std::vector<double> sharing() {
    shareClouds(closures_, around_, parameters_);
    std::vector<double> made;
    for (const MetricClosure& closure : closures_) {
      EXPECT_TRUE(closure.measured.information.isApprox(closure.measured.information(0, 0) * Matrix6d::Identity()));
      made.push_back(1.0 / closure.measured.information(0, 0));
    }
    return made;
  }

  testing::LineSurroundings around_;
  Parameters parameters_;
  std::vector<MetricClosure> closures_;
};

TEST_F(SharedClouds, thoseWithTheSameCloudsKnowWhatOneOfThemKnows) {
  for (int i = 0; i < 5; ++i) add(20, 120);
  add(20, 160);  // one cloud alone is the same
  add(60, 160);
  const std::vector<double> shared = sharing();
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(shared[static_cast<std::size_t>(i)], 5.0, 1e-9);
  EXPECT_NEAR(shared[5], 1.0, 1e-9);
  EXPECT_NEAR(shared[6], 1.0, 1e-9);
}

TEST_F(SharedClouds, partsCountAsParts) {
  add(20, 120);
  add(25, 110);  // 15 m and 10 m of 20 m
  add(115, 30);  // the other way about: 15 m and 10 m with the first, 15 m and 15 m with the second
  const std::vector<double> shared = sharing();
  EXPECT_NEAR(shared[0], 1.0 + 0.75 * 0.5 + 0.75 * 0.5, 1e-9);
  EXPECT_NEAR(shared[1], 1.0 + 0.75 * 0.5 + 0.75 * 0.75, 1e-9);
  EXPECT_NEAR(shared[2], 1.0 + 0.75 * 0.5 + 0.75 * 0.75, 1e-9);
}

TEST_F(SharedClouds, viewsAndWhatWasRejectedHaveNoPartInIt) {
  add(20, 120);
  add(20, 120, ClosureMethod::Stereo);
  add(20, 120, ClosureMethod::Icp, ClosureVerdict::Rejected);
  EXPECT_EQ(sharing(), std::vector<double>(3, 1.0));
}

}  // namespace
}  // namespace loop_metric
