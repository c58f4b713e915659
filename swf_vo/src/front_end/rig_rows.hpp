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

/// Estimates roll and shutter delay of the right camera from row disparities.
///
/// For a point whose row in the left image changes by v' px/s, the row in the right image minus that in the left one is
///   offset - roll (u - cx) + delay v':
/// the offset is caused by a pitch of the right camera, the second term by its roll about the optical axis, the third
/// by a later exposure. Least squares over new landmarks, each used once, with Huber weights and exponential
/// forgetting. Errors in one region of the image have a common cause (lens, rectification) and do not average out:
/// regions are the clusters of a sandwich estimator (Liang and Zeger 1986), and if its variance exceeds that of the
/// scatter of matches, the information is reduced by the ratio. The priors are those of a well-calibrated rig with the
/// tails of Student's t distribution, so that large errors can be estimated.
class RigRows {
 public:
  struct Priors {
    double roll = 0.0;     ///< standard deviation, rad
    double delay_s = 0.0;  ///< standard deviation, s
  };
  /// Measurement of one landmark.
  struct Difference {
    double px = 0.0;                                      ///< row in the right image minus row in the left one
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< direction of the landmark: (x, y) / z
    double flow_px_s = 0.0;                               ///< velocity of its row in the left image
  };

  /// The camera must outlive this object; its disparity offset may change.
  RigRows(const Priors& priors, const urban_nav_core::StereoCamera& camera);

  void see(const Difference& difference);
  /// Updates the estimate at the end of a frame.
  void learn();
  /// Takes the new landmarks of a frame. The velocities of their rows are computed from their positions and from the
  /// motion since the previous frame, `seconds` ago.
  void learn(const urban_nav_core::Pose& T_last_now, double seconds, const std::vector<Observation>& fresh,
             Tracks& tracks);
  /// Roll and delay estimated from all frames.
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
  double count_ = 0.0, variance_ = 0.0;     // weight and variance of residuals, px^2
  Vector3d estimate_ = Vector3d::Zero();    // offset (px), roll (rad), delay (s)
  Matrix3d covariance_ = Matrix3d::Zero();  // zero: no measurement yet
};

}  // namespace swf_vo
