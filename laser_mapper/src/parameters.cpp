// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/parameters.hpp"

#include <cstdint>

namespace laser_mapper {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "laser_mapper",
      {
          {"voxel", &P::voxel, "m", 0.05, 0.01, 1.0, {},
           "Distance between points of the map: edge of the cubes within which points are averaged.", "section 6.1"},
          {"min_range", &P::min_range, "m", 0.3, 0.0, 10.0, {},
           "Beams that end nearer to the laser, on the robot itself, are ignored.", "section 6.1"},
          {"max_range", &P::max_range, "m", 30.0, 1.0, 1000.0, {}, "Beams that end farther away are ignored.",
           "section 6.1"},
          {"range_sigma", &P::range_sigma, "m", 0.006, 0.0001, 1.0, {},
           "Standard deviation of a range.", "data sheet of the LMS291: 5 mm typical, resolution 1 mm"},
          {"range_bias", &P::range_bias, "m", 0.003, 0.0, 1.0, {},
           "Standard deviation of the constant error of a laser's ranges.", "docs/methods/laser_mapper.md"},
          {"beam_width", &P::beam_width, "rad", 0.011, 0.0, 0.2, {},
           "Divergence of the beams.", "data sheet of the LMS291"},
          {"mixed_pixels", &P::mixed_pixels, "", true, false, false, {},
           "Remove beams that hit two surfaces, whose range belongs to neither.",
           "docs/methods/laser_mapper.md"},
          {"ghosts", &P::ghosts, "", true, false, false, {},
           "Remove points of moving objects: those that beams of other times passed through.",
           "docs/methods/laser_mapper.md"},
          {"ghost_gap", &P::ghost_gap, "s", 20.0, 1.0, 1000000.0, {},
           "Minimum time between a beam that ended at a point and one that passed through it, for `ghosts`.",
           "docs/methods/laser_mapper.md", {}, Audience::Experts},
          {"stereo", &P::stereo, "", true, false, false, {},
           "Fill the map with points of dense stereo where there are no laser points.", "section 6.2"},
          {"stereo_sigma", &P::stereo_sigma, "m", 0.05, 0.001, 1.0, {},
           "Points of dense stereo with a larger standard deviation along the line of sight are ignored.",
           "docs/methods/laser_mapper.md", {}, Audience::Experts},
          {"depth_sigma", &P::depth_sigma, "m", 0.003, 1e-05, 1.0, {},
           "Standard deviation of a depth camera at 1 m; it grows with the squared depth.",
           "docs/methods/laser_mapper.md", {}, Audience::Experts},
          {"max_gap", &P::max_gap, "s", 0.5, 0.01, 10.0, {},
           "Beams between two poses of the trajectory that are further apart in time are ignored.",
           "section 6.1", {}, Audience::Experts},
          {"max_shift", &P::max_shift, "m", 0.005, 0.0, 10.0, {},
           "A part of the map is rendered again when its points have moved by more than this.",
           "docs/methods/laser_mapper.md", {}, Audience::Experts},
          {"constraints", &P::constraints, "", true, false, false, {},
           "Use planes measured by several passes as constraints of the pose graph in `map`.",
           "section 6.3; src/urban_nav/bench/plane_drift.cpp"},
      });
  return rows;
}
// clang-format on

}  // namespace laser_mapper
