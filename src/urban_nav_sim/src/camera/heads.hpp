// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "camera/imager.hpp"
#include "camera/rig.hpp"

namespace urban_nav_sim {

/// Which defects the cameras have.
struct CameraDefects {
  bool blurs = true;      ///< motion blur
  bool is_noisy = true;   ///< shot and read noise
  bool vignettes = true;  ///< and imagers of unequal sensitivity
  bool adapts = true;     ///< automatic exposure; without: that of the first picture
};

/// A Bumblebee2: two imagers, one shutter. Frames are taken in order of time, since the exposure of one follows from
/// those before; one thread at a time. The tracer, the sky and the motion must outlive it.
class StereoHead {
 public:
  StereoHead(const Tracer& tracer, const Sky& sky, StereoImages images, const urban_nav_core::Pose& T_base_left,
             std::uint64_t seed, const CameraDefects& defects = {});

  const std::array<Camera, 2>& cameras() const { return cameras_; }
  /// Left and right, 8 bit grey; `t`: middle of the exposure, s of the session.
  std::array<cv::Mat, 2> take(const Motion& motion, double t);
  /// Depth and class of the pair that was taken last, left and right.
  const std::array<Picture, 2>& pictures() const { return pictures_; }

 private:
  const Tracer& tracer_;
  const Sky& sky_;
  urban_nav_core::Pose T_base_left_;
  std::array<Camera, 2> cameras_;
  std::array<Imager, 2> imagers_;
  AutoExposure exposure_;
  std::array<Picture, 2> pictures_;
  std::uint64_t number_ = 0;
};

/// The ring of a Ladybug2: five cameras, each with its own shutter, fired at once. As above.
class LadybugHead {
 public:
  /// `T_base_head`: x forwards, z up, in the middle of the ring.
  LadybugHead(const Tracer& tracer, const Sky& sky, const urban_nav_core::Pose& T_base_head, std::uint64_t seed,
              const CameraDefects& defects = {});

  const std::array<Camera, 5>& cameras() const { return cameras_; }
  /// 8 bit, BGR, upright.
  std::array<cv::Mat, 5> take(const Motion& motion, double t);
  /// Depth and class of what was taken last.
  const std::array<Picture, 5>& pictures() const { return pictures_; }

 private:
  const Tracer& tracer_;
  const Sky& sky_;
  urban_nav_core::Pose T_base_head_;
  std::array<Camera, 5> cameras_;
  std::vector<Imager> imagers_;
  std::array<AutoExposure, 5> exposures_;
  std::array<Picture, 5> pictures_;
  std::uint64_t number_ = 0;
};

}  // namespace urban_nav_sim
