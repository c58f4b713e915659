// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

/// A point of one view that is seen in the other.
struct Sight {
  bool of_a = true;                                 ///< a point of a that is seen in b; else of b, seen in a
  int point = 0;                                    ///< in its own view
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();   ///< in its own view, where it is exact by definition; z = 1
  double disparity = 0.0, sigma_disparity = 1.0;    ///< there, px
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the other view
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< px^2
  double size = 1.0;  ///< px of level 0 in one of the pyramid level where it was measured
  /// What the other view says of the disparity there; no measurement where sigma is zero.
  double other_disparity = 0.0, other_sigma = 0.0;

  int coordinates() const { return other_sigma > 0.0 ? 3 : 2; }  ///< beyond the one that its depth takes
};

/// Perturbations: of T_a_b as boxPlus, of the error of all disparities (px), of this point's inverse depth (1/m).
inline constexpr int kOfOffset = 6, kOfDepth = 7;

/// Residuals of one sight, measured minus predicted: its own disparity, (u, v) in the other view, disparity there (zero
/// without one). Negative derivatives are left to who uses them: `J` is that of the prediction.
struct SightResidual {
  Eigen::Vector4d e = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 8> J = Eigen::Matrix<double, 4, 8>::Zero();
  bool visible = false;  ///< in front of the other camera; else nothing else is of use
};

/// Of a point at `inverse_depth` in its own view.
SightResidual computeResidual(const Sight& sight, const urban_nav_core::StereoCamera& camera,
                              const urban_nav_core::Pose& T_a_b, double offset, double inverse_depth);

/// 1/z by the sight's own disparity.
double inverseDepth(const Sight& sight, const urban_nav_core::StereoCamera& camera);

}  // namespace urban_nav_registration
