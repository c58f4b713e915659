// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/keyframe/mounted_camera.hpp"

namespace urban_nav_registration {

/// Converts keyframes of one camera to those of another camera at the same position: a recalibrated camera, or that of
/// another robot. The left image is resampled along its rays, which rotate with the mounting; points keep their rays
/// and depths. Pixels without data are black. Thread-safe.
class KeyframeConversion {
 public:
  KeyframeConversion(const MountedCamera& from, const MountedCamera& to);

  Keyframe convert(const Keyframe& keyframe) const;

  /// Returns T_base_virtual: base_link of a robot that carries the other camera at the position of this one. Converted
  /// keyframes refer to it. A pure translation, since the rotation is in the images.
  const urban_nav_core::Pose& T_base_virtual() const { return T_base_virtual_; }

 private:
  bool convertPoint(const KeyframePoint& point, KeyframePoint& result) const;

  urban_nav_core::StereoCamera from_, to_;
  urban_nav_core::Matrix3d R_to_from_;
  urban_nav_core::Pose T_base_virtual_;
};

/// Returns the conversion for a session with this fingerprint (calibrationFingerprint) to a camera; null if none is
/// needed. `is_known`: false if the fingerprint is absent or unreadable, and no keyframe of the session can be used.
std::shared_ptr<const KeyframeConversion> findConversion(const std::string& fingerprint, const MountedCamera& to,
                                                         bool& is_known);

}  // namespace urban_nav_registration
