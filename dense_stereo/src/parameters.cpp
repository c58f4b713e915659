// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/parameters.hpp"

#include <cstdint>

namespace dense_stereo {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "dense_stereo",
      {
          {"method", &P::method, "", std::string("sgm"), false, false, {"sgm", "paper"},
           "Semi-global matching with aligned slanted windows, or the local matcher of the paper (for comparison; in "
           "the command only).",
           "section 6.2; Hirschmueller 2008", {}, Audience::Experts},
          {"disparities", &P::disparities, "px", std::int64_t{64}, std::int64_t{16}, std::int64_t{512}, {},
           "Disparities searched, from 0, rounded up to a multiple of 16. Nearer surfaces are not matched.",
           "section 6.2"},
          {"min_component", &P::min_component, "px", std::int64_t{100}, std::int64_t{0}, std::int64_t{1000000}, {},
           "Connected patches of similar disparity with fewer pixels than this are removed.",
           "section 6.2", {}, Audience::Experts},
          {"max_sigma", &P::max_sigma, "px", 2.0, 0.05, 100.0, {},
           "Disparities with a larger standard deviation are invalid.",
           "dense_stereo/bench, accuracy", {}, Audience::Experts},
          {"max_range", &P::max_range, "m", 5.0, 0.5, 100.0, {},
           "Points farther from the camera than this are not used for ground, obstacles and maps. Cameras of a long "
           "baseline: up to the range where 0.1 px of disparity is 5 cm of depth.",
           "section 6.2"},
          {"obstacle_height", &P::obstacle_height, "m", 0.1, 0.02, 2.0, {},
           "Objects at least this high above the ground, or this deep below it, are obstacles.",
           "wheels of 24 cm radius"},
          {"clearance", &P::clearance, "m", 2.0, 0.1, 10.0, {},
           "Objects higher above the ground than this are not obstacles.", "height of the robot"},
          {"point_spacing", &P::point_spacing, "m", 0.1, 0.01, 1.0, {},
           "Edge of the cubes in which a map by planar lasers keeps the most accurate point of each keyframe.",
           "size of the store"},
          {"keyframe_distance", &P::keyframe_distance, "m", 0.25, 0.0, 100.0, {},
           "Distance travelled between pairs that map matches densely.", "budget of map"},
          {"keyframe_angle", &P::keyframe_angle, "rad", 0.175, 0.0, 7.0, {},
           "Rotation between pairs that map matches densely.", "budget of map", {}, Audience::Experts},
          {"keyframe_interval", &P::keyframe_interval, "s", 0.25, 0.0, 60.0, {},
           "Minimum time between pairs that map matches densely, and between live samples for the map.",
           "budget of map", {}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace dense_stereo
