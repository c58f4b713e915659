// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/reprojection.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::Vector6d;

StereoCamera measurementCamera() { return {{400.0, 410.0, 250.0, 190.0, 512, 384}, 0.12, 0.3}; }

PointMeasurement makeMeasurement(bool of_a) {
  PointMeasurement measurement;
  measurement.of_a = of_a;
  measurement.ray = {0.2, -0.1, 1.0};
  measurement.disparity = 6.0;
  measurement.sigma_disparity = 0.1;
  measurement.pixel = {300.0, 150.0};
  measurement.other_disparity = 7.0;
  measurement.other_sigma = 0.2;
  return measurement;
}

TEST(PointMeasurement, JacobianIsThatOfThePredictionAtLargeMotionsToo) {
  for (const bool of_a : {true, false})
    for (const double size : {0.0, 0.5, 1.0}) {
      const PointMeasurement measurement = makeMeasurement(of_a);
      const Pose T(urban_nav_core::expSo3(size * urban_nav_core::Vector3d(0.2, -0.5, 0.3)),
                   size * urban_nav_core::Vector3d(0.5, -0.3, 0.8));
      const double offset = 0.2, rho = 0.11;
      const MeasurementResidual r = computeResidual(measurement, measurementCamera(), T, offset, rho);
      ASSERT_TRUE(r.visible);
      const auto predicted = [&](const Pose& pose, double o, double depth) {
        return Eigen::Vector4d(-computeResidual(measurement, measurementCamera(), pose, o, depth).e);
      };
      const Eigen::Matrix<double, 4, 6> by_pose = urban_nav_core::testing::numericJacobian<4, 6>(
          [&](const Pose& pose) { return predicted(pose, offset, rho); }, T);
      const Eigen::Vector4d by_offset =
          urban_nav_core::testing::numericJacobian<4, 1>([&](double o) { return predicted(T, o, rho); }, offset);
      const Eigen::Vector4d by_depth =
          urban_nav_core::testing::numericJacobian<4, 1>([&](double d) { return predicted(T, offset, d); }, rho);
      EXPECT_LT((r.J.leftCols<6>() - by_pose).cwiseAbs().maxCoeff(), 1e-5 * by_pose.cwiseAbs().maxCoeff());
      EXPECT_LT((r.J.col(kOfOffset) - by_offset).norm(), 1e-8);
      EXPECT_LT((r.J.col(kOfDepth) - by_depth).norm(), 1e-5 * by_depth.norm());
    }
}

TEST(PointMeasurement, AgreesWithTheCameraOnAPoint) {
  const StereoCamera c = measurementCamera();
  const Pose T_a_b(urban_nav_core::expSo3({0.05, 0.2, -0.1}), {0.4, 0.1, 1.0});
  const urban_nav_core::Vector3d p_a(1.0, -0.5, 8.0), p_b = T_a_b.inverse() * p_a;
  for (const bool of_a : {true, false}) {
    const auto own = *c.project(of_a ? p_a : p_b), other = *c.project(of_a ? p_b : p_a);
    PointMeasurement measurement = makeMeasurement(of_a);
    measurement.ray = c.left.ray(own.head<2>());
    measurement.disparity = own[0] - own[2];
    measurement.pixel = other.head<2>();
    measurement.other_disparity = other[0] - other[2];
    EXPECT_LT(computeResidual(measurement, c, T_a_b, 0.0, inverseDepth(measurement, c)).e.norm(), 1e-9);
  }
}

TEST(PointMeasurement, NegativeDepthIsNotVisible) {
  PointMeasurement measurement = makeMeasurement(true);
  const Pose beyond(urban_nav_core::Quaterniond::Identity(), {0.0, 0.0, 100.0});
  EXPECT_FALSE(
      computeResidual(measurement, measurementCamera(), beyond, 0.0, inverseDepth(measurement, measurementCamera()))
          .visible);
}

}  // namespace
}  // namespace urban_nav_registration
