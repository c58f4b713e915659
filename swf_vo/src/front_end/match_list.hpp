// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/match.hpp"
#include "front_end/rotation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Returns the number of inliers that were found in both images.
int countInBoth(const std::vector<Match>& matches);

/// Lists the distances between inliers and their predictions in the left image, px.
void listPredictionErrors(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_expected_odom,
                          const std::vector<Match>& matches, std::vector<double>& errors);

/// Returns the sum of the squared distances of all matches, each at most that of an outlier; landmarks that were not
/// found in both images count as outliers.
double robustCost(const std::vector<Match>& matches);
/// Returns the ratio of a robust cost to that expected with the stated noise, at least 1: the variance factor by which
/// differences of costs exceed those of a chi-square.
double costDispersion(double cost, std::size_t matches);

/// Returns whether a landmark lies within the left image.
bool isInView(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
              const Match& match);

/// Returns whether only a small share of the landmarks in view supports a pose with so many `inliers`. With a large
/// search region some patches of any other place resemble earlier ones and a few are consistent by chance, as are
/// patches moving with the camera.
bool isByChance(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom, int inliers,
                const std::vector<Match>& matches);

/// Sets the coordinates of `match.z` that were not measured to their predictions, for pictures; their information stays
/// zero.
void fillIn(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom, Match& match);

/// Lists how far the camera's motion `t_now_last` (m) moves each landmark in the left image of the frame before.
void listParallax(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_last_odom,
                  const Eigen::Vector3d& t_now_last, const std::vector<Match>& matches,
                  std::vector<Parallax>& parallax);

}  // namespace swf_vo
