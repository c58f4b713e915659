// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swf_vo/frame.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

struct Ablation;

/// Stereo visual odometry by a Sliding Window Filter (Newman et al. 2009, section 2).
///
/// Feed it pairs in order of time. Every pair, whatever its state, gives a Frame with a finite pose and a proper
/// covariance; bad pairs give a status with its reason. It never throws for data, reads no clock, prints nothing and
/// allocates nothing once its buffers have grown. Not thread-safe: one caller at a time; different objects are
/// independent. The same calls give the same bits.
class SwfVo {
 public:
  /// T_base_camera: the left optical frame in base_link. Throws UserError where parameters or camera contradict
  /// themselves.
  SwfVo(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
        const urban_nav_core::Pose& T_base_camera);
  /// Continues where another object stood when `state` was taken from it. UserError that names what differs where
  /// parameters or calibration are others than that one had, DataError where the bytes are damaged or of another
  /// version.
  SwfVo(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
        const urban_nav_core::Pose& T_base_camera, std::string_view state);
  ~SwfVo();
  SwfVo(SwfVo&&) noexcept;
  SwfVo& operator=(SwfVo&&) noexcept;

  /// One stereo pair and the motion inputs that came since the last (may be empty). The result lives until the next
  /// call.
  const Frame& process(const urban_nav_core::StereoPair& pair,
                       const std::vector<urban_nav_core::MotionInput>& inputs = {});

  /// Empties the window: the frames that were still in it leave as settled, oldest first. The filter cannot go on after
  /// it.
  std::vector<Settled> flush();

  /// All that the answers to further calls depend on, as bytes: an object made from it gives the same bits as this one.
  /// Not after flush().
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
