// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/parameters.hpp"

#include <cstdint>

namespace loop_metric {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on a separate line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "loop_metric",
      {
          {"stereo", &P::stereo, "", true, false, false, {},
           "Register stereo keyframes.",
           "paper 4.1"},
          {"icp", &P::icp, "", true, false, false, {},
           "Align clouds if stereo keyframes could not be registered.",
           "paper 4.2"},
          {"stereo_tries", &P::stereo_tries, "", std::int64_t{2}, std::int64_t{1}, std::int64_t{20}, {},
           "Largest number of keyframe pairs to be matched.",
           "paper 4.1; measured", {}, Audience::Experts},
          {"keyframe_search_distance", &P::keyframe_search_distance, "m", 6.0, 0.0, 50.0, {},
           "Largest distance travelled between a pose and a keyframe that represents it.",
           "paper 3: places within 7.5 m", {"view_way"}, Audience::Experts},
          {"place_radius", &P::place_radius, "m", 9.0, 1.0, 100.0, {},
           "Largest distance between two poses of one place: candidates with a longer transform are rejected.",
           "paper 3: places within 7.5 m, and a fifth for uncertainty"},
          {"gate", &P::gate, "", 5.0, 1.0, 1000.0, {},
           "Largest difference of a transform from odometry and from its neighbours, in standard deviations (root "
           "mean square).",
           "paper 4", {}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace loop_metric
