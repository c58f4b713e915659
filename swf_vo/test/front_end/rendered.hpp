// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace swf_vo {

/// The renderer's camera as the filter knows it.
inline urban_nav_core::StereoCamera cameraOf(const urban_nav_core::testing::RenderCamera& rendered) {
  urban_nav_core::StereoCamera camera;
  camera.left.fx = rendered.fx;
  camera.left.fy = rendered.fy;
  camera.left.cx = rendered.cx;
  camera.left.cy = rendered.cy;
  camera.left.width = rendered.width;
  camera.left.height = rendered.height;
  camera.baseline = rendered.baseline;
  return camera;
}

/// A small camera, so that tests stay fast.
inline urban_nav_core::testing::SequenceOptions smallCamera(double noise = 1.0) {
  urban_nav_core::testing::SequenceOptions options;
  options.camera.fx = options.camera.fy = 250.0;
  options.camera.cx = 159.5;
  options.camera.cy = 119.5;
  options.camera.width = 320;
  options.camera.height = 240;
  options.noise = noise;
  return options;
}

}  // namespace swf_vo
