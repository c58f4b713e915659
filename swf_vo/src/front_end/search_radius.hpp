// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "front_end/match.hpp"
#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Search radius around the prediction of a landmark, px of level 0. Follows the prediction errors of the previous
/// frame; widened up to the uncertainty of the prediction if too few matches are found.
class SearchRadius {
 public:
  /// `usual`: the parameter `search_radius`, px.
  SearchRadius(double usual, const urban_nav_core::Pinhole& camera, std::size_t capacity)
      : usual_(usual), camera_(camera) {
    inverse_depths_.reserve(capacity);
  }

  double px() const { return radius_; }
  /// Sets the radius for unknown motion.
  void setUnknown();
  /// Sets the radius of the parameter.
  void setUsual() { radius_ = usual_; }
  /// Sets the limit for this frame: two standard deviations of the predicted translation (m), projected at the depth of
  /// the nearer landmarks seen from `T_camera_odom`; at least the radius of the parameter.
  void setLimit(double sigma_m, const urban_nav_core::Pose& T_camera_odom, const std::vector<Match>& matches);
  /// Widens to the limit. Returns false if the radius was at the limit already.
  bool widen();
  /// Updates the radius for the next frame from the distances between inliers and their predictions (px; reorders
  /// them).
  void learn(std::vector<double>& errors);
  /// Returns the radius for an unknown, large motion.
  double anywhere() const;

  void archive(urban_nav_core::Archive& archive);

 private:
  double widest() const;

  double usual_;
  urban_nav_core::Pinhole camera_;
  double radius_ = 0.0, limit_ = 0.0;
  std::vector<double> inverse_depths_;
};

}  // namespace swf_vo
