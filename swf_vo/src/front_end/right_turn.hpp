// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "front_end/disparity_step.hpp"
#include "health/row_check.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/camera/turned_right_camera.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/sequence/change_detector.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Steps of one frame, measured in corrected images.
struct RigStep {
  DisparityStep disparity;
  RowStep rows;
};

/// Detects that the right camera was turned against the left one, as by a knock, and corrects its images from then on.
/// Derivation: docs/derivations/rig_constants.md.
class RightTurn {
 public:
  explicit RightTurn(const urban_nav_core::StereoCamera& camera);

  /// Returns the pair with its right image corrected. Views of it are valid until the next call.
  urban_nav_core::StereoPair correct(const urban_nav_core::StereoPair& pair);
  /// Suggests the turn that the rows of matching points in corrected images show, for the next frame. For a turn after
  /// which hardly any point can be matched along rows. Without effect if no step was measured before the turn.
  void suggest(const std::vector<RowMatch>& matches, double row_offset_px);
  /// Returns the turn of the right camera that explains the steps of a frame, rad: the one suggested; or if one of the
  /// steps is too large for noise, or the disparity step ends a sum of steps (ChangeDetector) that is; else nullopt.
  std::optional<Eigen::Vector3d> propose(const RigStep& step, urban_nav_core::StampNs stamp);
  /// Returns the turn that explains the steps of a frame whose turn is known roughly, rad.
  Eigen::Vector3d refine(const RigStep& step) const;
  /// Returns whether rows show a turn about the x or z axis that is too large for noise.
  bool isLarge(const RowStep& rows) const;
  /// Corrects by another turn from this frame on.
  void set(const Eigen::Vector3d& turn) { right_.set(turn); }
  const Eigen::Vector3d& turn() const { return right_.turn(); }

  /// Adds the final step of a frame and returns it relative to the mounting in which the landmarks were measured: after
  /// a change it stays as large as the change until the landmarks are renewed.
  DisparityStep add(const DisparityStep& step, urban_nav_core::StampNs stamp);
  void archive(urban_nav_core::Archive& archive);

 private:
  urban_nav_core::StereoCamera camera_;
  double fx_;
  urban_nav_core::TurnedRightCamera right_;
  std::vector<std::uint8_t> pixels_;
  urban_nav_core::ChangeDetector detector_;         // of the present mounting
  double usual_px_ = 0.0, usual_sigma_ = -1.0;      // mean of the steps without a change; negative: none was measured
  double step_sigma_px_ = 0.0, step_sigmas_ = 0.0;  // recent mean of the standard deviations of steps; number of them
  Eigen::Vector3d final_turn_ = Eigen::Vector3d::Zero();  // of the frame before
  std::optional<Eigen::Vector3d> suggested_;              // turn for the next frame
  double changed_px_ = 0.0;              // increase of the disparity by the changes since the last renewal
  urban_nav_core::StampNs renewed_ = 0;  // from when on all landmarks are of the present mounting
};

}  // namespace swf_vo
