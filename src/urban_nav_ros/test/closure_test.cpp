// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/closure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

urban_nav_core::MetricClosure closure() {
  urban_nav_core::MetricClosure closure;
  closure.a = {"0123456789abcdef0123", 1'000'000'001};
  closure.b = {"", 2'000'000'002};
  closure.measured.T_a_b = Pose(urban_nav_core::expSo3(Vector3d(0.0, 0.1, -0.4)), Vector3d(1, 2, 3));
  closure.measured.information = (Vector6d() << 100, 0, 400, 900, 900, 1600).finished().asDiagonal();
  closure.measured.information(0, 5) = closure.measured.information(5, 0) = 7.0;
  closure.free_directions = {Vector6d::Unit(1)};
  closure.probability = 0.995;
  closure.method = ClosureMethod::Icp;
  closure.odometry_gate = true;
  closure.verdict = ClosureVerdict::Accepted;
  closure.reason = 3;
  closure.reason_name = "FacadeAlone";
  closure.sentence = "free along y";
  closure.evidence = "overlap 0.7";
  closure.source = "loop_metric";
  return closure;
}

TEST(MetricClosureMessage, ComesBackTheSame) {
  const auto message = toMetricClosureMessage(closure(), "base_link", 1.0);
  EXPECT_EQ(message.header.stamp, toRosTime(2'000'000'002));
  EXPECT_EQ(message.header.frame_id, "base_link");
  const auto back = toMetricClosure(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->a, closure().a);
  EXPECT_EQ(back->b, closure().b);
  EXPECT_TRUE(isApprox(back->measured, closure().measured, 1e-15));
  EXPECT_EQ(message.information[5], 7.0);
  ASSERT_EQ(back->free_directions.size(), 1U);
  EXPECT_EQ(back->free_directions[0], Vector6d(Vector6d::Unit(1)));
  EXPECT_EQ(back->probability, 0.995);
  EXPECT_EQ(back->method, ClosureMethod::Icp);
  EXPECT_TRUE(back->odometry_gate);
  EXPECT_EQ(back->verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(back->reason, 3);
  EXPECT_EQ(back->reason_name, "FacadeAlone");
  EXPECT_EQ(back->sentence, "free along y");
  EXPECT_EQ(back->evidence, "overlap 0.7");
  EXPECT_EQ(back->source, "loop_metric");
}

TEST(MetricClosureMessage, ShowsAFreeDirectionAsALargeCovariance) {
  const auto message = toMetricClosureMessage(closure(), "base_link", 1.0);
  EXPECT_NEAR(message.covariance[7], 1e6, 1.0);
  EXPECT_NEAR(message.covariance[14], 1.0 / 400.0, 1e-9);
}

TEST(MetricClosureMessage, ConvertsEveryMethodAndVerdict) {
  for (const ClosureMethod method : {ClosureMethod::None, ClosureMethod::Stereo, ClosureMethod::Icp}) {
    for (const ClosureVerdict verdict : {ClosureVerdict::Accepted, ClosureVerdict::Rejected}) {
      auto one = closure();
      one.method = method;
      one.verdict = verdict;
      const auto back = toMetricClosure(toMetricClosureMessage(one, "base_link", 1.0));
      ASSERT_TRUE(back);
      EXPECT_EQ(back->method, method);
      EXPECT_EQ(back->verdict, verdict);
    }
  }
}

TEST(MetricClosureMessage, RefusesWhatIsNone) {
  const auto good = toMetricClosureMessage(closure(), "base_link", 1.0);
  ASSERT_TRUE(toMetricClosure(good));
  auto bad = good;
  bad.T_a_b.orientation.w = 5.0;
  EXPECT_FALSE(toMetricClosure(bad));
  bad = good;
  bad.T_a_b.position.x = kNotANumber;
  EXPECT_FALSE(toMetricClosure(bad));
  bad = good;
  bad.information[3] = kNotANumber;
  EXPECT_FALSE(toMetricClosure(bad));
  bad = good;
  bad.information[5] = 8.0;
  EXPECT_FALSE(toMetricClosure(bad)) << "not symmetric";
  bad = good;
  bad.free_directions.push_back(1.0);
  EXPECT_FALSE(toMetricClosure(bad)) << "seven numbers";
  bad = good;
  bad.free_directions[2] = kNotANumber;
  EXPECT_FALSE(toMetricClosure(bad));
  bad = good;
  bad.method = 3;
  EXPECT_FALSE(toMetricClosure(bad));
  bad = good;
  bad.verdict = 2;
  EXPECT_FALSE(toMetricClosure(bad));
  for (const double probability : {-0.1, 1.1, kNotANumber}) {
    bad = good;
    bad.probability = probability;
    EXPECT_FALSE(toMetricClosure(bad)) << probability;
  }
}

TEST(TopologicalClosureMessage, ComesBackTheSame) {
  const urban_nav_core::TopologicalClosure closure{{"s", 5}, {"t", 7'000'000'009}, 0.75};
  const auto message = toTopologicalClosureMessage(closure);
  EXPECT_EQ(message.header.stamp, toRosTime(7'000'000'009));
  const auto back = toTopologicalClosure(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->a, closure.a);
  EXPECT_EQ(back->b, closure.b);
  EXPECT_EQ(back->probability, 0.75);
  auto bad = message;
  bad.probability = 2.0;
  EXPECT_FALSE(toTopologicalClosure(bad));
}

TEST(RelativeConstraintMessage, ComesBackTheSame) {
  urban_nav_core::RelativeConstraint constraint{{"s", 5}, {"s", 7}, {}, "plane", "laser_mapper"};
  constraint.measured.T_a_b = Pose(urban_nav_core::expSo3(Vector3d(0.5, 0.0, 0.0)), Vector3d(-1, 0, 2));
  constraint.measured.information(2, 2) = 1e4;
  const auto message = toRelativeConstraintMessage(constraint, "base_link");
  EXPECT_EQ(message.header.stamp, toRosTime(7));
  const auto back = toRelativeConstraint(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->a, constraint.a);
  EXPECT_EQ(back->b, constraint.b);
  EXPECT_TRUE(isApprox(back->measured, constraint.measured, 1e-15));
  EXPECT_EQ(back->kind, "plane");
  EXPECT_EQ(back->source, "laser_mapper");
  auto bad = message;
  bad.information[14] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(toRelativeConstraint(bad));
}

}  // namespace
}  // namespace urban_nav_ros
