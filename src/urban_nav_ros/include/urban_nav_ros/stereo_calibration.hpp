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

enum class Side { Left, Right };

/// Whether the images of a topic were rectified before they came, by a nodelet's parameter `images`: raw, rectified, or
/// auto, which asks whether the topic's name has `rect` in it, as image_proc names them.
bool areRectified(const std::string& images, const std::string& topic);

/// The calibration of a stereo pair of topics: what the two camera_info say, made into a rectified camera and, where
/// the images are raw, the maps that rectify them. Thread-safe.
class StereoCalibration {
 public:
  /// `images_are_rectified`: image_rect, whose camera_info still holds the distortion of the raw image. Throws
  /// UserError that begins with `where` where the two are no stereo pair.
  StereoCalibration(const urban_nav_core::CameraInfo& left, const urban_nav_core::CameraInfo& right,
                    bool images_are_rectified, const std::string& where);

  const urban_nav_core::StereoCamera& camera() const { return camera_; }
  /// The rectified left camera in the left optical frame that tf knows: a rotation, the identity where the calibration
  /// has none.
  const urban_nav_core::Pose& T_optical_rectified() const { return T_optical_rectified_; }
  bool rectifies() const { return left_map_.has_value(); }

  /// The image as the stereo camera sees it: the same where nothing is to be done, else a view into `out`. Empty where
  /// the image has not the size of the calibration.
  urban_nav_core::ImageView rectify(Side side, const urban_nav_core::ImageView& image,
                                    std::vector<std::uint8_t>& out) const;

 private:
  urban_nav_core::StereoCamera camera_;
  urban_nav_core::Pose T_optical_rectified_;
  int raw_width_, raw_height_;
  std::optional<urban_nav_core::RectifyMap> left_map_, right_map_;
};

}  // namespace urban_nav_ros
