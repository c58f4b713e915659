// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/align.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

namespace urban_nav_core {
namespace {

std::vector<Pose> randomPoses(int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> n;
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i)
    poses.emplace_back(expSo3({n(random), n(random), n(random)}), Vector3d(10 * n(random), 10 * n(random), n(random)));
  return poses;
}

// Returns the estimate that a similarity maps to `truth`.
std::vector<Pose> seenThrough(const Similarity& s, const std::vector<Pose>& truth) {
  std::vector<Pose> estimate;
  for (const Pose& pose : truth) {
    const Quaterniond q = s.T_truth_estimate.q().conjugate();
    estimate.emplace_back(q * pose.q(), (q * (pose.t() - s.T_truth_estimate.t())) / s.scale);
  }
  return estimate;
}

const Similarity kRigid{1.0, Pose(expSo3({0.4, -2.0, 1.0}), {5, 6, 7})};
const Similarity kScaled{1.7, Pose(expSo3({0.4, -2.0, 1.0}), {5, 6, 7})};

TEST(Align, FindsTheExactMotion) {
  const auto truth = randomPoses(20);
  EXPECT_TRUE(isApprox(alignSe3(truth, seenThrough(kRigid, truth)), kRigid, 1e-12));
  EXPECT_TRUE(isApprox(alignSim3(truth, seenThrough(kScaled, truth)), kScaled, 1e-12));
  EXPECT_TRUE(isApprox(alignFirst(truth, seenThrough(kRigid, truth)), kRigid, 1e-12));
}

TEST(Align, NoOtherMotionIsBetter) {
  const auto truth = randomPoses(20);
  auto estimate = seenThrough(kRigid, truth);
  std::mt19937 random(2);
  std::normal_distribution<double> n;
  for (Pose& pose : estimate) pose = Pose(pose.q(), pose.t() + Vector3d(n(random), n(random), n(random)));
  const auto cost = [&](const Similarity& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) sum += (truth[i].t() - s * estimate[i].t()).squaredNorm();
    return sum;
  };
  const Similarity se3 = alignSe3(truth, estimate), sim3 = alignSim3(truth, estimate);
  EXPECT_LT(cost(sim3), cost(se3));
  for (int i = 0; i < 6; ++i) {
    for (const double step : {-1e-3, 1e-3}) {
      EXPECT_GT(cost({1.0, boxPlus(se3.T_truth_estimate, Vector6d::Unit(i) * step)}), cost(se3));
      EXPECT_GT(cost({sim3.scale, boxPlus(sim3.T_truth_estimate, Vector6d::Unit(i) * step)}), cost(sim3));
    }
  }
  EXPECT_GT(cost({sim3.scale * 1.001, sim3.T_truth_estimate}), cost(sim3));
  EXPECT_GT(cost({sim3.scale * 0.999, sim3.T_truth_estimate}), cost(sim3));
}

TEST(Align, AMirrorImageIsNoRotation) {
  const auto truth = randomPoses(20);
  std::vector<Pose> mirrored;
  for (const Pose& pose : truth) mirrored.emplace_back(pose.q(), pose.t().cwiseProduct(Vector3d(1, 1, -1)));
  EXPECT_NEAR(alignSe3(truth, mirrored).T_truth_estimate.R().determinant(), 1.0, 1e-12);
}

TEST(Align, OnALineTheHeadingDecidesTheRest) {
  std::vector<Pose> truth;
  for (int i = 0; i < 10; ++i) truth.emplace_back(expSo3({0.1, 0.2, 0.3}), Vector3d(i, 2 * i, 0));
  EXPECT_TRUE(isApprox(alignSe3(truth, seenThrough(kRigid, truth)), kRigid, 1e-6));
  EXPECT_TRUE(isApprox(alignSim3(truth, seenThrough(kScaled, truth)), kScaled, 1e-6));
}

TEST(Align, StandingStillHasScaleOne) {
  const std::vector<Pose> truth(5, Pose(expSo3({0, 0, 1}), {1, 2, 3})), estimate(5, Pose());
  const Similarity s = alignSim3(truth, estimate);
  EXPECT_EQ(s.scale, 1.0);
  EXPECT_TRUE(isApprox(s.T_truth_estimate, truth[0], 1e-12));
}

TEST(Align, MovesPosesAndPrints) {
  EXPECT_TRUE(isApprox(kScaled * Pose(), Pose(kScaled.T_truth_estimate.q(), {5, 6, 7}), 0.0));
  std::ostringstream out;
  out << Similarity{2.0, Pose()};
  EXPECT_EQ(out.str(), "scale = 2, t = (0, 0, 0) m, rotation vector = (0, 0, 0) rad");
}

}  // namespace
}  // namespace urban_nav_core
