// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"

/// Parameters of the stereo camera. Every stage that measures with it has these rows under the same names and must be
/// given the same values (differingValues() in parameters/shared_settings.hpp).
namespace urban_nav_core {

/// Returns the row of `P::disparity_offset`, px.
template <typename P>
Row<P> disparityOffsetRow() {
  return {
      "disparity_offset",
      &P::disparity_offset,
      "px",
      0.1,
      0.0,
      5.0,
      {},
      "Standard deviation of a constant error of all disparities from calibration and rectification, estimated with "
      "the motion; 0 takes the calibration as exact. Common to all stages.",
      "swf_vo/bench, accuracy"};
}

/// Returns the row of `P::pixel_noise_floor`, px.
template <typename P>
Row<P> pixelNoiseFloorRow() {
  return {"pixel_noise_floor",
          &P::pixel_noise_floor,
          "px",
          0.03,
          0.001,
          5.0,
          {},
          "Standard deviation added to that of each measured pixel, for errors not modelled by the patch alignment. "
          "Common to all stages.",
          "swf_vo/bench, consistency"};
}

/// Returns the names of these parameters.
inline std::vector<std::string> cameraNoiseNames() { return {"disparity_offset", "pixel_noise_floor"}; }

}  // namespace urban_nav_core
