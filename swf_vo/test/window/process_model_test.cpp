// SPDX-License-Identifier: BSD-3-Clause
#include "window/process_model.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::boxPlus;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

const Pose kLast(urban_nav_core::expSo3(Eigen::Vector3d(0.5, -0.3, 1.2)), Eigen::Vector3d(4.0, -2.0, 1.0));
const Pose kU(urban_nav_core::expSo3(Eigen::Vector3d(0.02, 0.1, -0.05)), Eigen::Vector3d(0.1, 0.02, 0.4));

Pose nextAt(double translation, double angle) {
  Vector6d off;
  off << 0.6 * translation, -0.64 * translation, 0.48 * translation, 0.6 * angle, 0.64 * angle, -0.48 * angle;
  return boxPlus(kLast * kU, off);
}

TEST(ProcessModel, PredictionHasNoResidual) {
  EXPECT_LT(process_model::residual(kLast, process_model::predict(kLast, {kU, Matrix6d::Zero()}), kU).e.norm(), 1e-14);
}

TEST(ProcessModel, JacobiansHoldAtLargeResiduals) {
  for (const auto& [translation, angle] : {std::pair{0.0, 0.0}, {0.01, 0.01}, {0.5, 0.7}}) {
    const Pose next = nextAt(translation, angle);
    const auto at = process_model::residual(kLast, next, kU);
    const auto by_last = urban_nav_core::testing::numericJacobian<6, 6>(
        [&](const Pose& T) { return process_model::error(T, next, kU); }, kLast);
    const auto by_next = urban_nav_core::testing::numericJacobian<6, 6>(
        [&](const Pose& T) { return process_model::error(kLast, T, kU); }, next);
    EXPECT_LT((at.last - by_last).norm(), 1e-8) << angle;
    EXPECT_LT((at.next - by_next).norm(), 1e-8) << angle;
  }
}

TEST(ProcessModel, MovingBothPosesTogetherChangesNothing) {
  const Pose next = nextAt(0.5, 0.7);
  const auto at = process_model::residual(kLast, next, kU);
  const auto moves = [](const Pose& T) {
    Matrix6d M = Matrix6d::Identity();
    M.topRightCorner<3, 3>() = -urban_nav_core::skew(T.t());
    return M;
  };
  EXPECT_LT((at.last * moves(kLast) + at.next * moves(next)).norm(), 1e-13);
}

}  // namespace
}  // namespace swf_vo
