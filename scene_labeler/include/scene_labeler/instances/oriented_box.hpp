// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace scene_labeler {

/// Rectangle in plan view.
struct OrientedBox {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
  double heading = 0.0;                              ///< rad, direction of `length`, 0...pi
  double length = 0.0, width = 0.0;                  ///< m, length >= width

  /// Returns the coordinates of a point relative to the centre, along and across.
  Eigen::Vector2d toBox(const Eigen::Vector2d& point) const;
  /// Returns whether a point lies in the box extended by `margin`, m, on each side.
  bool holds(const Eigen::Vector2d& point, double margin = 0.0) const;
};

/// Returns the box around points whose edges are nearest to them: the fit to L-shaped outlines of vehicles by the
/// closeness criterion (Zhang et al. 2017, "Efficient L-shape fitting for vehicle detection using laser scanners"). The
/// area of a box does not determine its heading for a vehicle of which two sides were seen. Half a per cent of the
/// points may be outside at each edge. Deterministic. Points without extent have heading 0.
OrientedBox fitBox(const std::vector<Eigen::Vector2d>& points);

}  // namespace scene_labeler
