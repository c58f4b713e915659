// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "front_end/tracks.hpp"
#include "observation.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// What the rows of the right image say of how the pair is mounted and triggered.
///
/// A point whose row in the left image moves by v' px/s stands in the right image lower by
///   offset - roll (u - cx) + delay v':
/// a right camera that is pitched shows everything lower, one that is rolled about its optical axis shows the right
/// half higher than the left one, and one that opens later shows where points have moved to. Least squares over new
/// landmarks, each once, with Huber's weights; rows far in the past fade. Errors of one place of the image have one
/// cause (lens, rectification) and do not average out: places are the clusters of a sandwich estimator (Liang and Zeger
/// 1986), and if it states more variance than the scatter of matches does, all is believed by so much less. Priors are
/// what a well-calibrated rig has, with the tails of Student's t: one that is far off is found.
class RigRows {
 public:
  struct Priors {
    double roll = 0.0;     ///< standard deviation, rad
    double delay_s = 0.0;  ///< standard deviation, s
  };
  /// Of one landmark.
  struct Difference {
    double px = 0.0;                                      ///< row in the right image minus row in the left one
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< of the landmark: (x, y) / z
    double flow_px_s = 0.0;                               ///< by which its row in the left image grows
  };

  /// The camera must outlive it, and may learn its disparity offset.
  RigRows(const Priors& priors, const urban_nav_core::StereoCamera& camera);

  void see(const Difference& difference);
  /// At the end of a frame.
  void learn();
  /// A frame's new landmarks. How their rows move follows from their places and from the motion since the frame before,
  /// which is so many seconds ago.
  void learn(const urban_nav_core::Pose& T_last_now, double seconds, const std::vector<Observation>& fresh,
             Tracks& tracks);
  /// Roll and delay by all frames.
  RigConstants evaluate() const;
  void archive(urban_nav_core::Archive& archive);

 private:
  using Vector3d = Eigen::Vector3d;
  using Matrix3d = Eigen::Matrix3d;
  static constexpr int kColumns = 8, kRows = 6;
  struct Cell {
    Matrix3d information = Matrix3d::Zero();  // per px^2
    Vector3d right = Vector3d::Zero();
    void fade(double kept);
    void archive(urban_nav_core::Archive& archive);
  };
  Cell& find(const Eigen::Vector2d& direction);

  Priors priors_;
  const urban_nav_core::StereoCamera& camera_;
  std::array<Cell, kColumns * kRows> cells_;
  Cell all_;
  double count_ = 0.0, variance_ = 0.0;     // of residuals, px^2
  Vector3d estimate_ = Vector3d::Zero();    // offset (px), roll (rad), delay (s)
  Matrix3d covariance_ = Matrix3d::Zero();  // zero: nothing seen
};

}  // namespace swf_vo
