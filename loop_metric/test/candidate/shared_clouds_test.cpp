// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/shared_clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/line_place_data.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

/// A metre per second, 200 m along a line; clouds extend 10 m to both sides.
class SharedClouds : public ::testing::Test {
 protected:
  SharedClouds() {
    std::vector<Pose> poses;
    for (int i = 0; i <= 200; ++i) poses.emplace_back(Eigen::Quaterniond::Identity(), Eigen::Vector3d(i, 0.0, 0.0));
    around_.drive("day", poses, 0.01, 0.001);
    parameters_.registration.cloud_half_length = 10.0;
  }
  void add(int a, int b, ClosureMethod method = ClosureMethod::Icp, ClosureVerdict verdict = ClosureVerdict::Accepted) {
    MetricClosure result;
    result.a = {"day", a * StampNs{1'000'000'000}};
    result.b = {"day", b * StampNs{1'000'000'000}};
    result.method = method;
    result.verdict = verdict;
    result.measured.information = Matrix6d::Identity();
    closures_.push_back(result);
  }
  /// Returns the factors by which the information of the closures was divided.
  std::vector<double> sharing() {
    discountSharedClouds(closures_, around_, parameters_);
    std::vector<double> result;
    for (const MetricClosure& closure : closures_) {
      EXPECT_TRUE(closure.measured.information.isApprox(closure.measured.information(0, 0) * Matrix6d::Identity()));
      result.push_back(1.0 / closure.measured.information(0, 0));
    }
    return result;
  }

  /// Returns the remaining shares of information for closures in order of arrival.
  std::vector<double> kept() {
    std::vector<double> result;
    for (std::size_t i = 0; i < closures_.size(); ++i) {
      MetricClosure discounted = closures_[i];
      discountAgainst(discounted, {closures_.begin(), closures_.begin() + static_cast<std::ptrdiff_t>(i)}, around_,
                      parameters_);
      EXPECT_TRUE(
          discounted.measured.information.isApprox(discounted.measured.information(0, 0) * Matrix6d::Identity()));
      result.push_back(discounted.measured.information(0, 0));
    }
    return result;
  }
  double keptTogether() {
    const std::vector<double> each = kept();
    return std::accumulate(each.begin(), each.end(), 0.0);
  }

  testing::LinePlaceData around_;
  Parameters parameters_;
  std::vector<MetricClosure> closures_;
};

TEST_F(SharedClouds, ThoseWithTheSameCloudsHaveTheInformationOfOne) {
  for (int i = 0; i < 5; ++i) add(20, 120);
  add(20, 160);  // only one cloud is the same
  add(60, 160);
  const std::vector<double> shared = sharing();
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(shared[static_cast<std::size_t>(i)], 5.0, 1e-9);
  EXPECT_NEAR(shared[5], 1.0, 1e-9);
  EXPECT_NEAR(shared[6], 1.0, 1e-9);
}

TEST_F(SharedClouds, PartsCountAsParts) {
  add(20, 120);
  add(25, 110);  // 15 m and 10 m of 20 m
  add(115, 30);  // reversed: 15 m and 10 m with the first, 15 m and 15 m with the second
  const std::vector<double> shared = sharing();
  EXPECT_NEAR(shared[0], 1.0 + 0.75 * 0.5 + 0.75 * 0.5, 1e-9);
  EXPECT_NEAR(shared[1], 1.0 + 0.75 * 0.5 + 0.75 * 0.75, 1e-9);
  EXPECT_NEAR(shared[2], 1.0 + 0.75 * 0.5 + 0.75 * 0.75, 1e-9);
}

TEST_F(SharedClouds, ViewsAndWhatWasRejectedHaveNoPartInIt) {
  add(20, 120);
  add(20, 120, ClosureMethod::Stereo);
  add(20, 120, ClosureMethod::Icp, ClosureVerdict::Rejected);
  EXPECT_EQ(sharing(), std::vector<double>(3, 1.0));
}

TEST_F(SharedClouds, SequentiallyARepeatedClosureHasNoInformation) {
  for (int i = 0; i < 100; ++i) add(20, 120);
  add(120, 20);  // reversed
  add(20, 160);  // only one cloud is the same
  const std::vector<double> each = kept();
  EXPECT_EQ(each[0], 1.0);
  for (std::size_t i = 1; i <= 100; ++i) EXPECT_NEAR(each[i], 0.0, 0.0011);
  EXPECT_GT(each[1], 0.0) << "zero information would mean a closure without measurement";
  EXPECT_EQ(each[101], 1.0);
  EXPECT_LT(keptTogether(), 2.2);
}

TEST_F(SharedClouds, OneAfterAnotherPartsCountAsParts) {
  add(20, 120);
  add(25, 110);  // 15 m and 10 m of 20 m are discounted
  add(35,
      120);  // 5 m and 20 m by the first, 10 m and 10 m by the second, which have a quarter of 20 m times 10 m in
             // common
  const std::vector<double> each = kept();
  EXPECT_EQ(each[0], 1.0);
  EXPECT_NEAR(each[1], 1.0 - 0.75 * 0.5, 1e-9);
  EXPECT_NEAR(each[2], 1.0 - 0.25 - 0.5 * 0.5 + 0.25 * 0.5, 1e-9);
}

TEST_F(SharedClouds, TheirTotalInformationIsIndependentOfTheOrder) {
  for (int i = 0; i < 60; ++i) add(20 + i, 160 - i + (i * 7) % 5);
  const double in_order = keptTogether();
  EXPECT_GT(in_order, 4.0);  // 60 m on both sides, of which a cloud covers 20 m
  EXPECT_LT(in_order, 12.0);
  std::reverse(closures_.begin(), closures_.end());
  EXPECT_NEAR(keptTogether(), in_order, 0.05);
  std::sort(closures_.begin(), closures_.end(),
            [](const MetricClosure& x, const MetricClosure& y) { return x.a.stamp * 37 % 61 < y.a.stamp * 37 % 61; });
  EXPECT_NEAR(keptTogether(), in_order, 0.05);
}

TEST_F(SharedClouds, OneAfterAnotherViewsAndWhatWasRejectedHaveNoPartInIt) {
  add(20, 120, ClosureMethod::Stereo);
  add(20, 120, ClosureMethod::Icp, ClosureVerdict::Rejected);
  add(20, 120);
  add(20, 120, ClosureMethod::Stereo);
  EXPECT_EQ(kept(), std::vector<double>(4, 1.0));
}

}  // namespace
}  // namespace loop_metric
