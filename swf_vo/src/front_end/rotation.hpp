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
  bool found = false;  ///< descended to a lower difference than the start had; else q_now_last is the start
  double before = 0.0, after = 0.0;  ///< root mean square difference at the start and the end, grey levels
};

/// A place of the last image whose depth is known, and what the predicted translation does to it.
struct Parallax {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the last image, px of level 0
  urban_nav_core::Vector3d shift =
      urban_nav_core::Vector3d::Zero();  ///< t_now_last / depth, so that its ray becomes R ray + shift
};

/// Step (ii) of section 2.4: the rotation between two frames that makes their smallest images most alike (sum of
/// squared differences, with brightness and contrast free), by efficient second-order minimisation (Mei et al. 2008;
/// Benhimane and Malis 2004).
///
/// The paper neglects the translation, which holds at 20 Hz and walking speed. Over 1.2 m a frame in a street (KITTI
/// 06) the rotation of the whole images was found wrong by 1 to 2 deg, so where landmarks give the depth the sums are
/// made around them, with the predicted translation taken into account; else over the whole image.
class RotationTracker {
 public:
  /// `camera`: of level 0.
  explicit RotationTracker(const urban_nav_core::Pinhole& camera) : camera_(camera) {}

  /// Turns the image kept last into this one, starting from `start`, and from no turn where `start` is a
  /// large one; keeps this image. The first image, or one of
  /// another size, gives `found` false. `known`: may be empty.
  RotationEstimate track(const urban_nav_core::ImageView& image, int level, const urban_nav_core::Quaterniond& start,
                         const std::vector<Parallax>& known);
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Plane {
    int width = 0, height = 0;
    std::vector<float> grey, du, dv;
  };
  struct Sample {
    std::size_t at = 0;  // in last_
    Eigen::Vector3f ray, shift;
  };
  struct Normal;
  struct Descent {
    urban_nav_core::Quaterniond q;
    double before, after;  // root mean square difference, grey levels; below zero: the images do not overlap
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
