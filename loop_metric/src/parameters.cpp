// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/parameters.hpp"

#include <cstdint>

namespace loop_metric {

using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "loop_metric",
      {
          {"points", &P::points, "", std::int64_t{500}, std::int64_t{50}, std::int64_t{5000}, {},
           "Points of a keyframe, spread over the image, that two views are matched by.", "section 4.1"},
          {"min_matches", &P::min_matches, "", std::int64_t{50}, std::int64_t{10}, std::int64_t{5000}, {},
           "A transform by stereo needs as many matches that agree with it.", "section 4.1"},
          {"max_reprojection_error", &P::max_reprojection_error, "px", 0.2, 0.01, 10.0, {},
           "And their mean reprojection error must be below this.", "section 4.1"},
          {"min_share", &P::min_share, "", 0.3, 0.0, 1.0, {},
           "And of the points that the other view should show, this share must be there: what is only alike in parts has few.",
           "loop_metric/bench, pairs"},
          {"disparity_offset", &P::disparity_offset, "px", 0.1, 0.0, 5.0, {},
           "Standard deviation of a constant error of all disparities, left by calibration; 0 takes the calibration as exact.",
           "swf_vo.disparity_offset"},
          {"pixel_noise_floor", &P::pixel_noise_floor, "px", 0.03, 0.001, 5.0, {},
           "Standard deviation added to that of every measured pixel: what the patch alignment cannot know of.",
           "swf_vo.pixel_noise_floor"},
      });
  return rows;
}
// clang-format on

}  // namespace loop_metric
