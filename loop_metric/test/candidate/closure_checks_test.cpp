// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/closure_checks.hpp"

#include <gtest/gtest.h>

#include "support/line_place_data.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

/// Two passes along the same twenty metres, half a metre apart.
class ClosureChecks : public ::testing::Test {
 protected:
  ClosureChecks() {
    std::vector<Pose> poses;
    for (const double y : {0.0, 0.5})
      for (int i = 0; i < 20; ++i) poses.push_back(at(i, y));
    place_data_.drive("day", poses, 0.01, 0.001);
  }
  static Pose at(double x, double y) { return Pose(urban_nav_core::Quaterniond::Identity(), {x, y, 0.0}); }
  static MetricClosure closure(int metre, const Pose& T_a_b = at(0.0, 0.5)) {
    MetricClosure result;
    result.a = {"day", metre * StampNs{1'000'000'000}};
    result.b = {"day", (20 + metre) * StampNs{1'000'000'000}};
    result.method = ClosureMethod::Icp;
    result.measured.T_a_b = T_a_b;
    result.measured.information.diagonal() << Eigen::Vector3d::Constant(1e4), Eigen::Vector3d::Constant(1e6);
    result.verdict = ClosureVerdict::Accepted;
    return result;
  }

  testing::LinePlaceData place_data_;
  Parameters parameters_;
};

TEST_F(ClosureChecks, ASingleClosureKeepsItsInformationInEitherMode) {
  std::vector<MetricClosure> batch = {closure(3)};
  applyChecks(batch, place_data_, parameters_);
  MetricClosure live = closure(3);
  SequentialChecks().apply(live, place_data_, parameters_);
  EXPECT_TRUE(batch[0].measured.information.isApprox(closure(3).measured.information));
  EXPECT_TRUE(live.measured.information.isApprox(closure(3).measured.information));
}

TEST_F(ClosureChecks, EqualClosuresTogetherKeepTheInformationOfOne) {
  std::vector<MetricClosure> batch = {closure(3), closure(3)};
  applyChecks(batch, place_data_, parameters_);
  EXPECT_TRUE(batch[0].measured.information.isApprox(0.5 * closure(3).measured.information));
  SequentialChecks live;
  MetricClosure first = closure(3), second = closure(3);
  live.apply(first, place_data_, parameters_);
  live.apply(second, place_data_, parameters_);
  EXPECT_TRUE(first.measured.information.isApprox(closure(3).measured.information));
  EXPECT_LT(second.measured.information(0, 0), 0.01 * first.measured.information(0, 0));
  EXPECT_GT(second.measured.information(0, 0), 0.0);
}

TEST_F(ClosureChecks, AContradictionOfSeveralNeighboursIsRejectedInEitherMode) {
  const MetricClosure wrong = closure(4, at(2.0, 0.5));
  std::vector<MetricClosure> batch = {closure(2), closure(3), closure(5), wrong};
  applyChecks(batch, place_data_, parameters_);
  SequentialChecks live;
  for (const int metre : {2, 3, 5}) {
    MetricClosure right = closure(metre);
    live.apply(right, place_data_, parameters_);
    EXPECT_EQ(right.verdict, ClosureVerdict::Accepted);
  }
  MetricClosure last = wrong;
  live.apply(last, place_data_, parameters_);
  EXPECT_EQ(batch[3].verdict, ClosureVerdict::Rejected);
  EXPECT_EQ(last.verdict, ClosureVerdict::Rejected);
}

TEST_F(ClosureChecks, RejectedClosuresAreNoEvidence) {
  SequentialChecks live;
  for (const int metre : {2, 3, 5}) {
    MetricClosure rejected = closure(metre, at(2.0, 0.5));
    rejected.verdict = ClosureVerdict::Rejected;
    live.apply(rejected, place_data_, parameters_);
  }
  MetricClosure right = closure(4);
  live.apply(right, place_data_, parameters_);
  EXPECT_EQ(right.verdict, ClosureVerdict::Accepted);
  EXPECT_TRUE(right.measured.information.isApprox(closure(4).measured.information));
}

}  // namespace
}  // namespace loop_metric
