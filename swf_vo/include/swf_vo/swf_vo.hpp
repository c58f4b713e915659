// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swf_vo/frame.hpp"
#include "swf_vo/parameters.hpp"
#include "swf_vo/propagation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

struct Ablation;

/// Stereo visual odometry by a Sliding Window Filter (Newman et al. 2009, section 2).
///
/// Pairs are processed in order of time. Every pair gives a Frame with a finite pose and a valid covariance; unusable
/// pairs give a status with its reason. Bad data never causes an exception. Reads no clock, prints nothing, does not
/// allocate once its buffers have grown. Not thread-safe; different objects are independent. Deterministic: equal calls
/// give bit-identical results.
class SwfVo {
 public:
  /// T_base_camera: left optical frame in base_link. Throws UserError if parameters or camera are inconsistent.
  SwfVo(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
        const urban_nav_core::Pose& T_base_camera);
  /// Resumes from `state` of another object. Throws UserError, naming the difference, if parameters or calibration
  /// differ from those of that object; DataError if the bytes are damaged or of another version.
  SwfVo(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
        const urban_nav_core::Pose& T_base_camera, std::string_view state);
  ~SwfVo();
  SwfVo(SwfVo&&) noexcept;
  SwfVo& operator=(SwfVo&&) noexcept;

  /// Processes one stereo pair with the motion inputs received since the previous one (may be empty). The result is
  /// valid until the next call.
  const Frame& process(const urban_nav_core::StereoPair& pair,
                       const std::vector<urban_nav_core::MotionInput>& inputs = {});

  /// Returns the propagation of the newest frame's pose by motion sensors. Requires that a pair has been processed.
  Propagation propagation() const;

  /// Empties the window: returns its frames as settled, oldest first. process() must not be called afterwards.
  std::vector<Settled> flush();

  /// Returns the complete state as bytes: an object constructed from it gives bit-identical results. Not after flush().
  std::string state() const;

 private:
  class Implementation;
  friend class AblatedSwfVo;  // for comparison: in library swf_vo_ablation
  SwfVo(const Ablation& ablation, const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
        const urban_nav_core::Pose& T_base_camera);
  SwfVo(const Ablation& ablation, const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
        const urban_nav_core::Pose& T_base_camera, std::string_view state);

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
