// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/brightness_equations.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace laser_mapper {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kBrightnessSeconds = 9;  // corrections in the dense equations
constexpr double kBrightnessVariance = 0.04;

std::vector<BrightnessRow> drawRows(std::size_t count, urban_nav_core::testing::Dice& dice) {
  std::vector<BrightnessRow> rows(count);
  for (BrightnessRow& row : rows) {
    row.residual = dice.normal();
    for (Index i = 0; i < kCalibrationTerms; ++i) row.terms(i) = dice.normal();
    for (Index i = 0; i < 6; ++i) {
      row.at_view(i) = dice.normal();
      row.at_point(i) = dice.normal();
    }
    row.view_share = {2U * static_cast<std::uint32_t>(&row - rows.data()) % 7U, 0.3};
    row.point_share = {4U, 0.8};  // the same seconds as some views
  }
  return rows;
}

/// Returns the row for all unknowns: terms, corrections, brightness of each point.
VectorXd denseRow(const BrightnessRow& row, Index point, Index points) {
  VectorXd dense = VectorXd::Zero(static_cast<Index>(kCalibrationTerms + 6 * kBrightnessSeconds) + points);
  dense.head<kCalibrationTerms>() = row.terms;
  const auto addCorrection = [&](const PoseCorrection& derivatives, const FreeTrajectory::Share& share) {
    const Index at = kCalibrationTerms + 6 * static_cast<Index>(share.second);
    dense.segment<6>(at) += (1.0 - share.next) * derivatives;
    dense.segment<6>(at + 6) += share.next * derivatives;
  };
  addCorrection(row.at_view, row.view_share);
  addCorrection(row.at_point, row.point_share);
  dense(dense.size() - points + point) = 1.0;
  return dense;
}

TEST(BrightnessEquations, AreTheNormalEquationsWithoutTheBrightnessOfThePoints) {
  urban_nav_core::testing::Dice dice(40);
  const std::vector<std::vector<BrightnessRow>> points{drawRows(5, dice), drawRows(3, dice)};
  const Index count = 2, kept = kCalibrationTerms + 6 * static_cast<Index>(kBrightnessSeconds);
  MatrixXd H = MatrixXd::Zero(kept + count, kept + count);
  VectorXd b = VectorXd::Zero(kept + count);
  for (Index p = 0; p < count; ++p)
    for (const BrightnessRow& row : points[static_cast<std::size_t>(p)]) {
      const VectorXd dense = denseRow(row, p, count);
      H += dense * dense.transpose() / kBrightnessVariance;
      b -= row.residual * dense / kBrightnessVariance;
    }
  const MatrixXd inverse = H.bottomRightCorner(count, count).diagonal().cwiseInverse().asDiagonal();
  const MatrixXd expected =
      H.topLeftCorner(kept, kept) - H.topRightCorner(kept, count) * inverse * H.bottomLeftCorner(count, kept);
  const VectorXd gradient = b.head(kept) - H.topRightCorner(kept, count) * inverse * b.tail(count);

  const PlaceEquations sum = sumBrightnessRows(points, kBrightnessVariance);
  MatrixXd made = MatrixXd::Zero(kept, kept);
  VectorXd made_gradient = VectorXd::Zero(kept);
  made.topLeftCorner<kCalibrationTerms, kCalibrationTerms>() =
      sum.information.topLeftCorner<kCalibrationTerms, kCalibrationTerms>();
  made_gradient.head<kCalibrationTerms>() = sum.gradient.head<kCalibrationTerms>();
  for (std::size_t i = 0; i < sum.seconds.size(); ++i) {
    const Index from = kCalibrationTerms + static_cast<Index>(6 * i), to = kCalibrationTerms + 6 * sum.seconds[i];
    made_gradient.segment<6>(to) = sum.gradient.segment<6>(from);
    made.block<6, kCalibrationTerms>(to, 0) = sum.information.block<6, kCalibrationTerms>(from, 0);
    for (std::size_t j = 0; j <= i; ++j)
      made.block<6, 6>(to, kCalibrationTerms + 6 * sum.seconds[j]) =
          sum.information.block<6, 6>(from, kCalibrationTerms + static_cast<Index>(6 * j));
  }
  urban_nav_core::mirrorLowerInPlace(made);
  EXPECT_NEAR((made - expected).norm(), 0.0, 1e-9 * expected.norm());
  EXPECT_NEAR((made_gradient - gradient).norm(), 0.0, 1e-9 * gradient.norm());
}

TEST(BrightnessEquations, WithoutRowsThereIsNothing) {
  const PlaceEquations none = sumBrightnessRows({}, kBrightnessVariance);
  EXPECT_TRUE(none.seconds.empty());
  EXPECT_EQ(none.information.norm(), 0.0);
}

}  // namespace
}  // namespace laser_mapper
