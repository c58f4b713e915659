// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "camera/imager.hpp"
#include "camera/rig.hpp"

namespace urban_nav_sim {

/// Defects of the cameras.
struct CameraDefects {
  bool blurs = true;      ///< motion blur
  bool is_noisy = true;   ///< shot and read noise
  bool vignettes = true;  ///< and imagers of unequal sensitivity
  bool adapts = true;     ///< automatic exposure; false: that of the first picture
};

/// A Bumblebee2: two imagers, one shutter. Frames must be taken in order of time, since exposure depends on previous
/// ones. Not thread-safe. The tracer, the sky and the motion must outlive it.
class StereoHead {
 public:
  StereoHead(const Tracer& tracer, const Sky& sky, StereoImages images, const urban_nav_core::Pose& T_base_left,
             std::uint64_t seed, const CameraDefects& defects = {});

  const std::array<Camera, 2>& cameras() const { return cameras_; }
  /// Returns left and right image, 8 bit grey; `t`: middle of the exposure, s of the session.
  std::array<cv::Mat, 2> take(const Motion& motion, double t);
  /// Returns depth and class of the last pair, left and right.
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

/// The ring of a Ladybug2: five synchronised cameras with separate shutters. Requirements as for StereoHead.
class LadybugHead {
 public:
  /// `T_base_head`: x forward, z up, at the centre of the ring.
  LadybugHead(const Tracer& tracer, const Sky& sky, const urban_nav_core::Pose& T_base_head, std::uint64_t seed,
              const CameraDefects& defects = {});

  const std::array<Camera, 5>& cameras() const { return cameras_; }
  /// Moves the head on the robot, as by a knock.
  void place(const urban_nav_core::Pose& T_base_head) { T_base_head_ = T_base_head; }
  /// Returns upright images, 8 bit BGR.
  std::array<cv::Mat, 5> take(const Motion& motion, double t);
  /// Returns depth and class of the last images.
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
