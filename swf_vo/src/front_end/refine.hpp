// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

inline constexpr double kLeastCorrelation = 0.8;  ///< between a patch and its template; below, the match is rejected

/// Returns 1/z of the landmark in the camera of its first observation, from the current map.
double inverseDepthWhereBorn(const Match& match);

/// Warps the track's template into one image for a camera pose. Returns false if the view differs too much in scale or
/// slant.
bool prepareTemplate(Side side, const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                     Match& match);

/// Aligns the prepared template to the image from `start` (px of level 0), by at most `reach` px of its level.
PixelMeasurement refine(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& start,
                        double reach);

/// Updates the slant of the landmark's surface from its measurement in the left image, if the camera has moved far
/// enough since the last update. Requires the templates of that measurement.
void learnSurface(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                  const urban_nav_core::Pose& T_camera_odom, Match& match);

/// Returns the template drift since the last trusted measurement: covariance of the displacement over the surface, px^2
/// in the current view, from the change of the left view since then. Sets Track::seen_as to the view at T_camera_odom.
Eigen::Matrix2d creep(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                      Match& match);

/// Transforms a covariance (px^2) from the current left view (Track::seen_as) to the view of the track's first
/// observation.
Eigen::Matrix2d whereBorn(const Track& track, const Eigen::Matrix2d& covariance);

/// Returns the covariance of the displacement of a measurement caused by blur relative to the first observation, px^2
/// of level 0: the template is blurred by a Gaussian, which approximates the blur of the camera.
Eigen::Matrix2d displacedByBlur(const Track& track, bool in_left);

/// Adds a covariance common to both images, and a variance of the disparity (px^2), to a measurement.
void loosen(const Eigen::Matrix2d& covariance, double of_disparity, Match& match);

/// Rounds the measurements to whole pixels of their level (no subpixel refinement, for comparison).
void roundToPixels(Match& match);

/// Combines both measurements into one (u_left, v, u_right), with the row as weighted mean of both. `floor_px` is added
/// to the standard deviation of each coordinate. The row refers to the left image: `row_offset` (RowOffset) is
/// subtracted from that of the right one. Not measured if neither image has a measurement, or if the rows are
/// inconsistent.
void combine(double floor_px, Match& match, double row_offset = 0.0);

}  // namespace swf_vo
