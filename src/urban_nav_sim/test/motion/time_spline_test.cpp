// SPDX-License-Identifier: BSD-3-Clause
#include "motion/time_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_sim {
namespace {

TimeSpline wavy() {
  std::vector<Vector6> control;
  for (int i = 0; i < 40; ++i) {
    Vector6 point;
    for (int j = 0; j < 6; ++j) point[j] = std::sin(1.7 * i * (j + 1)) + 0.3 * i;
    control.push_back(point);
  }
  return {-1.0, 0.1, control};
}

TEST(TimeSpline, StraightPolygonsStayStraight) {
  std::vector<Vector6> control;
  for (int i = 0; i < 12; ++i) control.push_back(Vector6::Constant(3.0 + 0.5 * i));
  const TimeSpline spline(2.0, 0.25, control);
  for (double t = spline.begin(); t < spline.end(); t += 0.07) {
    const auto at = spline.at(t);
    EXPECT_NEAR(at.value[4], 3.0 + 2.0 * (t - 2.0), 1e-12);
    EXPECT_NEAR(at.rate[4], 2.0, 1e-11);
    EXPECT_NEAR(at.change[4], 0.0, 1e-10);
  }
}

TEST(TimeSpline, DerivativesAreThoseOfTheValue) {
  const TimeSpline spline = wavy();
  constexpr double kH = 1e-4;
  for (double t = spline.begin() + kH; t < spline.end() - kH; t += 0.0317) {
    const auto low = spline.at(t - kH), here = spline.at(t), high = spline.at(t + kH);
    EXPECT_LT(((high.value - low.value) / (2 * kH) - here.rate).norm(), 2e-4 * (1.0 + here.rate.norm()));
    EXPECT_LT(((high.rate - low.rate) / (2 * kH) - here.change).norm(), 2e-4 * (1.0 + here.change.norm()));
  }
}

TEST(TimeSpline, FourthDerivativeIsContinuousAtTheJoints) {
  const TimeSpline spline = wavy();
  constexpr double kH = 2e-3;
  // Second differences of `change` on either side of a joint; the fifth derivative bounds how much they may differ.
  const auto fourth = [&](double t) {
    return Vector6((spline.at(t + kH).change - 2.0 * spline.at(t).change + spline.at(t - kH).change) / (kH * kH));
  };
  for (int i = 1; i < 30; ++i) {
    const double joint = spline.begin() + 0.1 * i;
    const Vector6 before = fourth(joint - kH), after = fourth(joint + kH), far = fourth(joint + 0.05);
    EXPECT_LT((after - before).norm(), 0.15 * (before.norm() + far.norm()) + 1e-3) << i;
  }
}

TEST(TimeSpline, GoesOnALittleBeyondItsEnds) {
  const TimeSpline spline = wavy();
  EXPECT_LT((spline.at(spline.end() + 1e-6).value - spline.at(spline.end() - 1e-6).value).norm(), 1e-3);
  EXPECT_LT((spline.at(spline.begin() + 1e-6).value - spline.at(spline.begin() - 1e-6).value).norm(), 1e-3);
}

}  // namespace
}  // namespace urban_nav_sim
