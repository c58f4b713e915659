// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace swf_vo {

using urban_nav_core::testing::makeCamera;

/// A small camera, for fast tests.
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
