// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/image/view.hpp"

namespace swf_vo {

struct RotationEstimate {
  urban_nav_core::Quaterniond q_now_last = urban_nav_core::Quaterniond::Identity();
  bool found = false;          ///< descended to a lower difference than the start had; else q_now_last is the start
  double before = 0.0, after = 0.0;  ///< root mean square difference at the start and the end, grey levels
};

/// Step (ii) of section 2.4: the rotation between two frames that makes their smallest images most alike (sum of squared
/// differences, with brightness and contrast free), by efficient second-order minimisation (Mei et al. 2008; Benhimane and
/// Malis 2004). Good where the translation is small against the depth; what it is off by elsewhere is left to the search window.
class RotationTracker {
 public:
  /// `camera`: of level 0.
  explicit RotationTracker(const urban_nav_core::Pinhole& camera) : camera_(camera) {}

  /// Turns the image kept last into this one, starting from `start`, and keeps this one. The first image, or one of another
  /// size, gives `found` false.
  RotationEstimate track(const urban_nav_core::ImageView& image, int level, const urban_nav_core::Quaterniond& start);

 private:
  struct Plane {
    int width = 0, height = 0;
    std::vector<float> grey, du, dv;
  };
  void fill(const urban_nav_core::ImageView& image, Plane& plane) const;
  struct Normal;
  Normal sum(const Plane& last, const Plane& now, int level, const urban_nav_core::Matrix3d& R) const;

  urban_nav_core::Pinhole camera_;
  Plane last_, now_;
};

}  // namespace swf_vo
