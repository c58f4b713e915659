// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "calibration/free_trajectory.hpp"

namespace laser_mapper {

/// How the brightness that a view shows of a point, logarithm less the exposure, differs from that of its other views.
struct BrightnessRow {
  double residual = 0.0;
  TermVector terms = TermVector::Zero();             ///< derivatives by the terms of the head,
  PoseCorrection at_view = PoseCorrection::Zero();   ///< by the correction of the trajectory at the time of the view,
  PoseCorrection at_point = PoseCorrection::Zero();  ///< and by that at the time of the beams that made the point
  FreeTrajectory::Share view_share, point_share;     ///< these times
};

/// Returns the equations of the points of one place, by the rows of each point's views, from which the brightness of
/// each point is eliminated. `variance`: of a row.
PlaceEquations sumBrightnessRows(const std::vector<std::vector<BrightnessRow>>& points, double variance);

}  // namespace laser_mapper
