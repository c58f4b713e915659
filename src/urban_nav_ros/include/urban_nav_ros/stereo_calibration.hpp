// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"

namespace urban_nav_ros {
/// Camera of the stereo pair.
enum class Side { Left, Right };

/// Returns whether the images of a topic are rectified, by a nodelet's parameter `images`: raw, rectified, or auto, by
/// which topics with `rect` in their names are rectified, as named by image_proc.
bool areRectified(const std::string& images, const std::string& topic);

/// Calibration of a stereo pair of topics: the rectified camera from both camera_info and, for raw images, the maps
/// that rectify them. Thread-safe.
class StereoCalibration {
 public:
  /// `images_are_rectified`: image_rect, whose camera_info still has the distortion of the raw image. Throws UserError
  /// that begins with `where` if the two are not a stereo pair.
  StereoCalibration(const urban_nav_core::CameraInfo& left, const urban_nav_core::CameraInfo& right,
                    bool images_are_rectified, const std::string& where);

  const urban_nav_core::StereoCamera& camera() const { return camera_; }
  /// Returns the rectified left camera in the left optical frame of tf: a rotation, the identity if the calibration has
  /// none.
  const urban_nav_core::Pose& T_optical_rectified() const { return T_optical_rectified_; }
  bool rectifies() const { return left_map_.has_value(); }

  /// Returns the rectified image: the image itself if it is rectified, else a view of `out`. Empty if the image does
  /// not have the size of the calibration.
  urban_nav_core::ImageView rectify(Side side, const urban_nav_core::ImageView& image,
                                    std::vector<std::uint8_t>& out) const;

 private:
  urban_nav_core::StereoCamera camera_;
  urban_nav_core::Pose T_optical_rectified_;
  int raw_width_, raw_height_;
  std::optional<urban_nav_core::RectifyMap> left_map_, right_map_;
};

}  // namespace urban_nav_ros
