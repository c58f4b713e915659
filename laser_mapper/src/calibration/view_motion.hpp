// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "calibration/calibration_terms.hpp"
#include "laser_mapper/calibration/view_calibration.hpp"

namespace laser_mapper {

/// Returns the correction of a camera head by its terms: T_base_camera = correction * T_base_camera as stated. Shift
/// and turn are in the axes of base_link, the turn about `centre`.
urban_nav_core::Pose headCorrection(const TermVector& terms, const urban_nav_core::Vector3d& centre);

/// Transform of map points to the frame of a camera, q = R p + t, with derivatives with respect to the terms of its
/// head.
struct ViewMotion {
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  std::array<Eigen::Matrix3d, kCalibrationTerms> dR;  ///< per s, m and rad
  std::array<Eigen::Vector3d, kCalibrationTerms> dt;

  /// Returns the derivatives of q, a column per term.
  Eigen::Matrix<double, 3, kCalibrationTerms> derivatives(const Eigen::Vector3d& p) const;
};

/// Returns nullopt if the trajectory does not cover the time of the view.
std::optional<ViewMotion> viewMotionAt(const MountedView& view, const urban_nav_core::Trajectory& T_map_base,
                                       const urban_nav_core::Vector3d& centre, const TermVector& terms);

}  // namespace laser_mapper
