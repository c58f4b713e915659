// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/free_trajectory.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace laser_mapper {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

constexpr StampNs kFreeBegin = 1'000'000'000;

Trajectory drivenFor(int seconds) {
  Trajectory trajectory;
  for (int i = 0; i <= 20 * seconds; ++i)
    trajectory.append(kFreeBegin + static_cast<StampNs>(i) * 50'000'000,
                      Pose(Eigen::Quaterniond::Identity(), urban_nav_core::Vector3d(0.05 * i, 0.0, 0.0)));
  return trajectory;
}

/// Equations of a place that depends on the corrections at some seconds.
PlaceEquations drawPlace(std::vector<std::uint32_t> seconds, urban_nav_core::testing::Dice& dice) {
  const auto size = static_cast<Index>(kCalibrationTerms + 6 * seconds.size());
  MatrixXd root(size, size);
  PlaceEquations place{std::move(seconds), {}, VectorXd(size)};
  for (Index i = 0; i < size; ++i) {
    place.gradient(i) = dice.normal();
    for (Index j = 0; j < size; ++j) root(i, j) = dice.normal();
  }
  place.information = root * root.transpose();
  return place;
}

TEST(FreeTrajectory, AStepIsThatOfAllUnknownsTogether) {
  const Trajectory trajectory = drivenFor(4);
  const TrajectoryPrior prior(trajectory, nullptr, kFreeBegin, 5);
  FreeTrajectory free(trajectory, nullptr, {kFreeBegin, kFreeBegin + 4'000'000'000}, kCalibrationTerms);
  ASSERT_EQ(free.corrections().size(), 5U);
  urban_nav_core::testing::Dice dice(3);
  const std::vector<PlaceEquations> places{drawPlace({0, 1, 3}, dice), drawPlace({2, 3, 4}, dice)};

  const Index size = kCalibrationTerms + 30;
  MatrixXd H = MatrixXd::Zero(size, size), walk = MatrixXd::Zero(30, 30);
  VectorXd b = VectorXd::Zero(size), walk_gradient = VectorXd::Zero(30);
  prior.addTo(free.corrections(), walk, walk_gradient);
  H.bottomRightCorner(30, 30) = walk;
  for (const PlaceEquations& place : places) {
    std::vector<Index> to;
    for (Index i = 0; i < kCalibrationTerms; ++i) to.push_back(i);
    for (const std::uint32_t second : place.seconds)
      for (Index i = 0; i < 6; ++i) to.push_back(kCalibrationTerms + 6 * static_cast<Index>(second) + i);
    for (std::size_t i = 0; i < to.size(); ++i) {
      b(to[i]) += place.gradient(static_cast<Index>(i));
      for (std::size_t j = 0; j < to.size(); ++j)
        if (to[i] >= to[j]) H(to[i], to[j]) += place.information(static_cast<Index>(i), static_cast<Index>(j));
    }
  }
  VectorXd step = b;
  MatrixXd spoilt = H;
  ASSERT_TRUE(urban_nav_core::solvePositiveDefiniteInPlace(spoilt, step));

  free.clear();
  for (const PlaceEquations& place : places) free.add(place);
  const TermEquations equations = free.eliminate();
  EXPECT_EQ(equations.patches, 2U);
  const auto covariance = urban_nav_core::invertPositiveDefinite(equations.information);
  ASSERT_TRUE(covariance);
  const VectorXd terms = *covariance * equations.gradient;
  EXPECT_NEAR((terms - step.head<kCalibrationTerms>()).norm(), 0.0, 1e-8 * step.norm());
  free.move(terms);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR((free.corrections()[k] - step.segment<6>(kCalibrationTerms + static_cast<Index>(6 * k))).norm(), 0.0,
                1e-8 * step.norm())
        << k;
}

TEST(FreeTrajectory, CorrectionsAreLinearBetweenSeconds) {
  const FreeTrajectory free(drivenFor(3), nullptr, {kFreeBegin, kFreeBegin + 3'000'000'000}, kCalibrationTerms);
  const FreeTrajectory::Share share = free.shareAt(kFreeBegin + 1'250'000'000);
  EXPECT_EQ(share.second, 1U);
  EXPECT_NEAR(share.next, 0.25, 1e-12);
  EXPECT_EQ(free.shareAt(0).second, 0U) << "before the stretch as at its beginning";
  EXPECT_LT(free.shareAt(kFreeBegin + 60'000'000'000).second + 1U, free.corrections().size());
}

TEST(FreeTrajectory, LongDrivesAreDividedEvenly) {
  EXPECT_TRUE(divideTrajectory({}).empty());
  const std::vector<CalibrationInterval> one = divideTrajectory(drivenFor(20));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.front().begin, kFreeBegin);
  EXPECT_EQ(one.front().end, kFreeBegin + 20'000'000'001);
  const std::vector<CalibrationInterval> three = divideTrajectory(drivenFor(700));
  ASSERT_EQ(three.size(), 3U);
  EXPECT_EQ(three[0].end, three[1].begin);
  EXPECT_NEAR(static_cast<double>(three[1].end - three[1].begin), 700e9 / 3.0, 2.0);
}

}  // namespace
}  // namespace laser_mapper
