// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "calibration/free_trajectory.hpp"

namespace laser_mapper {

/// Residual of a point's brightness in a view, logarithm minus exposure, relative to its other views.
struct BrightnessRow {
  double residual = 0.0;
  TermVector terms = TermVector::Zero();             ///< derivatives with respect to the terms of the head,
  PoseCorrection at_view = PoseCorrection::Zero();   ///< to the correction of the trajectory at the time of the view,
  PoseCorrection at_point = PoseCorrection::Zero();  ///< and to that at the time of the beams of the point
  FreeTrajectory::Share view_share, point_share;     ///< interpolation weights of these times
};

/// Returns the equations of the points of one place from the rows of each point's views; the brightness of each point
/// is eliminated. `variance`: of a row.
PlaceEquations sumBrightnessRows(const std::vector<std::vector<BrightnessRow>>& points, double variance);

}  // namespace laser_mapper
