// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

inline constexpr double kLeastCorrelation =
    0.8;  ///< of a patch with its template, below which it is not the same thing

/// 1/z of the landmark in the camera that first saw it, by the map of now.
double inverseDepthWhereBorn(const Match& match);

/// Makes the track's template for one image ready for a camera pose; false if it is seen too large, too small or too
/// slanted.
bool prepareTemplate(Side side, const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                     Match& match);

/// Aligns the template that was made ready to the image from `start` (px of level 0), at most `reach` px of its level.
PixelMeasurement refine(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& start,
                        double reach);

/// Learns how the landmark's surface slants from its sighting in the left image, once the camera has moved far enough
/// since this was done last. The templates must be those of the sighting.
void learnSurface(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                  const urban_nav_core::Pose& T_camera_odom, Match& match);

/// By how much what the template stands for may have crept over its surface since it was last trusted, px^2 in the view
/// of now, by the change of the left view from then to T_camera_odom, which is noted (Track::seen_as).
Eigen::Matrix2d creep(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                      Match& match);

/// A covariance in the left view of now (Track::seen_as), px^2, said of the view in which the track was born.
Eigen::Matrix2d whereBorn(const Track& track, const Eigen::Matrix2d& covariance);

/// What a sighting may be off by since the view is less sharp than where the track was born, px^2 of level 0: the
/// template was blurred as well, but how exactly the camera does it is unknown.
Eigen::Matrix2d displacedByBlur(const Track& track, bool in_left);

/// Adds a covariance that both images share, and a variance of the disparity (px^2), to a measurement.
void loosen(const Eigen::Matrix2d& covariance, double of_disparity, Match& match);

/// Puts the sightings onto the pixels of their level, as without any refinement.
void roundToPixels(Match& match);

/// The two sightings as one measurement (u_left, v, u_right): the row counts once, weighed by both. `floor_px` is added
/// to the standard deviation of each coordinate. The row is the left image's: the right one's is `row_offset`
/// (RowOffset) less than was sighted. Not measured if neither image has it, or if the rows contradict each other.
void combine(double floor_px, Match& match, double row_offset = 0.0);

}  // namespace swf_vo
