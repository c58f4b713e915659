// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>
#include <urban_nav_msgs/GroundPlane.h>

#include "dense_stereo/near_scene.hpp"
#include "urban_nav_core/image/view.hpp"

namespace dense_stereo {

/// Converts disparities in the convention of stereo_image_proc: without the disparity offset, -1 where invalid.
/// `disparities`: search range.
stereo_msgs::DisparityImage toDisparityMessage(const DisparityImage& image, const urban_nav_core::StereoCamera& camera,
                                               int disparities, const std_msgs::Header& header);
/// Converts all disparities to a cloud with the rows and columns of the image and the fields x, y, z, rgb; NaN where
/// invalid.
sensor_msgs::PointCloud2 toPointsMessage(const DisparityImage& image, const urban_nav_core::StereoCamera& camera,
                                         const urban_nav_core::ImageView& left, const std_msgs::Header& header);
urban_nav_msgs::GroundPlane toGroundMessage(const GroundPlane& ground, const std_msgs::Header& header);
/// Converts obstacles to a cloud with the fields x, y, z, height.
sensor_msgs::PointCloud2 toObstaclesMessage(const std::vector<ObstaclePoint>& obstacles,
                                            const std_msgs::Header& header);

}  // namespace dense_stereo
