// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

/// A point of one view measured in the other.
struct PointMeasurement {
  bool of_a = true;                                          ///< a point of a measured in b; false: of b, measured in a
  int point = 0;                                             ///< index in its own view
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();            ///< in its own view, exact by definition; z = 1
  double disparity = 0.0, sigma_disparity = 1.0;             ///< in its own view, px
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();           ///< in the other view
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< px^2
  double size = 1.0;  ///< px of level 0 per pixel of the pyramid level of the measurement
  /// Disparity measured in the other view; none if sigma is zero.
  double other_disparity = 0.0, other_sigma = 0.0;

  int coordinates() const { return other_sigma > 0.0 ? 3 : 2; }  ///< besides the one that determines its depth
};

/// Indices of perturbations: T_a_b as boxPlus (0...5), error common to all disparities (px), inverse depth of this
/// point (1/m).
inline constexpr int kOfOffset = 6, kOfDepth = 7;

/// Residuals of one measurement, measured minus predicted: its own disparity, (u, v) in the other view, disparity there
/// (zero without a measurement). `J` is the derivative of the prediction, without the negative sign.
struct MeasurementResidual {
  Eigen::Vector4d e = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 8> J = Eigen::Matrix<double, 4, 8>::Zero();
  bool visible = false;  ///< in front of the other camera; false: the other members are undefined
};

/// Computes the residual for an inverse depth `inverse_depth` in its own view.
MeasurementResidual computeResidual(const PointMeasurement& measurement, const urban_nav_core::StereoCamera& camera,
                                    const urban_nav_core::Pose& T_a_b, double offset, double inverse_depth);

/// Returns 1/z from the measurement's own disparity.
double inverseDepth(const PointMeasurement& measurement, const urban_nav_core::StereoCamera& camera);

}  // namespace urban_nav_registration
