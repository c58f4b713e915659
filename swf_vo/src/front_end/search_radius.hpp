// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "front_end/match.hpp"
#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// How far around its prediction a landmark is looked for, px of level 0. It follows what the prediction was off by in
/// the frame before; where that finds too little it widens to what the uncertainty of the prediction allows.
class SearchRadius {
 public:
  /// `usual`: the parameter `search_radius`, px.
  SearchRadius(double usual, const urban_nav_core::Pinhole& camera, std::size_t capacity)
      : usual_(usual), camera_(camera) {
    inverse_depths_.reserve(capacity);
  }

  double px() const { return radius_; }
  /// The radius where nothing is known of the motion.
  void setUnknown();
  /// The radius of the parameter.
  void setUsual() { radius_ = usual_; }
  /// Sets the limit of this frame: two standard deviations of the predicted translation (m) as the nearer landmarks,
  /// seen from `T_camera_odom`, show them; at least the usual radius.
  void setLimit(double sigma_m, const urban_nav_core::Pose& T_camera_odom, const std::vector<Match>& matches);
  /// Widens to the limit. Returns false where it was there already.
  bool widen();
  /// Learns how wide to search next time from the distances of inliers from where they were expected (px, in any order,
  /// which is changed).
  void learn(std::vector<double>& errors);
  /// The radius for a motion of which nothing is known but that it is a large one.
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
