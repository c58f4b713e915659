// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/image/view.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

struct RotationEstimate {
  urban_nav_core::Quaterniond q_now_last = urban_nav_core::Quaterniond::Identity();
  bool found = false;                ///< the difference decreased; else q_now_last is the start
  double before = 0.0, after = 0.0;  ///< root mean square difference at the start and the end, grey levels
};

/// A pixel of the previous image with known depth, and the effect of the predicted translation on it.
struct Parallax {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the last image, px of level 0
  urban_nav_core::Vector3d shift =
      urban_nav_core::Vector3d::Zero();  ///< t_now_last / depth, so that its ray becomes R ray + shift
};

/// Step (ii) of section 2.4: rotation between two frames by direct alignment of their smallest pyramid levels (sum of
/// squared differences, with free brightness and contrast), by efficient second-order minimisation (Mei et al. 2008;
/// Benhimane and Malis 2004).
///
/// The paper neglects the translation, which is valid at 20 Hz and walking speed. At 1.2 m a frame in a street (KITTI
/// 06) the rotation of whole images has errors of 1 to 2 deg, so where landmarks provide depth the sums are taken
/// around them, including the predicted translation; else over the whole image.
class RotationTracker {
 public:
  /// `camera`: intrinsics of level 0.
  explicit RotationTracker(const urban_nav_core::Pinhole& camera) : camera_(camera) {}

  /// Estimates the rotation from the previous image to this one, starting from `start`, and also from identity if
  /// `start` is large; stores this image. `found` is false for the first image and after a change of size. `known`: may
  /// be empty.
  RotationEstimate track(const urban_nav_core::ImageView& image, int level, const urban_nav_core::Quaterniond& start,
                         const std::vector<Parallax>& known);
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Plane {
    int width = 0, height = 0;
    std::vector<float> grey, du, dv;
  };
  struct Sample {
    std::size_t at = 0;  // index in last_
    Eigen::Vector3f ray, shift;
  };
  struct Normal;
  struct Descent {
    urban_nav_core::Quaterniond q;
    double before, after;  // root mean square difference, grey levels; negative: no overlap
  };
  static void fill(const urban_nav_core::ImageView& image, Plane& plane);
  void choose(int level, const std::vector<Parallax>& known);
  Normal sum(int level, const urban_nav_core::Matrix3d& R) const;
  Descent descend(int level, const urban_nav_core::Quaterniond& start) const;

  urban_nav_core::Pinhole camera_;
  Plane last_, now_;
  std::vector<Sample> samples_;
};

}  // namespace swf_vo
