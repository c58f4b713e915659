// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/parameters.hpp"

#include <cstdint>

#include "urban_nav_core/camera/camera_noise.hpp"

namespace swf_vo {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "swf_vo",
      {
          {"window", &P::window, "frames", std::int64_t{10}, std::int64_t{1}, std::int64_t{100000}, {},
           "Number of poses in the window. Larger is more accurate and slower; 1 is an extended Kalman filter, the "
           "number of all frames the batch solution.",
           "paper 2.2"},
          {"features", &P::features, "at 512x384 px", std::int64_t{100}, std::int64_t{20}, std::int64_t{2000}, {},
           "Number of features tracked at a time; scaled with the image area to the power of 2/3.",
           "paper 2.4 (v)"},
          urban_nav_core::pixelNoiseFloorRow<P>(),
          urban_nav_core::disparityOffsetRow<P>(),
          {"rig_scale", &P::rig_scale, "%", 0.05, 0.0, 10.0, {},
           "Relative standard deviation of focal length times baseline after calibration: a scale error of all "
           "lengths, which images cannot reveal. Included in the covariances of poses, not in those of steps.",
           "docs/methods/swf_vo.md"},
          {"right_roll", &P::right_roll, "deg", 0.05, 1e-4, 10.0, {},
           "Standard deviation of the roll of the right camera after rectification; estimated and reported.",
           "docs/methods/swf_vo.md", {}, Audience::Experts},
          {"shutter_delay", &P::shutter_delay, "ms", 0.1, 1e-4, 100.0, {},
           "Standard deviation of the delay of the right shutter; estimated and reported.",
           "docs/methods/swf_vo.md", {}, Audience::Experts},
          {"robust_covariance", &P::robust_covariance, "", true, false, false, {},
           "Scale the drift in covariances by the residuals over the lifetime of each landmark; otherwise it follows "
           "from the measurement noise only.",
           "Liang, Zeger, Biometrika 1986", {}, Audience::Experts},
          {"huber", &P::huber, "standard deviations", 2.5, 0.0, 100.0, {},
           "Threshold of the Huber kernel: larger residuals are weighted linearly; 0 disables the kernel.",
           "paper 2.2", {}, Audience::Experts},
          {"iterations", &P::iterations, "", std::int64_t{3}, std::int64_t{1}, std::int64_t{100}, {},
           "Maximum number of Gauss-Newton steps per frame; fewer at convergence.",
           "paper 2.1", {}, Audience::Experts},
          {"acceleration", &P::acceleration, "m/s^2", 10.0, 0.01, 1000.0, {},
           "Process noise without a motion input u: standard deviation of the change of velocity in one second.",
           "paper 2.1, eq. 1"},
          {"angular_acceleration", &P::angular_acceleration, "rad/s^2", 10.0, 0.01, 1000.0, {},
           "Process noise without a motion input u: standard deviation of the change of angular velocity in one "
           "second.", "paper 2.1, eq. 1"},
          {"search_radius", &P::search_radius, "px", 24.0, 4.0, 200.0, {},
           "Half-width of the search window around the projection of a landmark, after compensation of the rotation "
           "between the frames.",
           "paper 2.4 (iii)"},
          {"pyramid_levels", &P::pyramid_levels, "", std::int64_t{3}, std::int64_t{1}, std::int64_t{6}, {},
           "Number of image scales for corner extraction, each half the size of the previous one.",
           "paper 2.4 (i)", {}, Audience::Experts},
          {"fast_threshold", &P::fast_threshold,
           "grey levels", std::int64_t{12}, std::int64_t{3}, std::int64_t{100}, {},
           "Contrast threshold of FAST corners; lowered automatically if an image has too few.",
           "paper 2.4 (i)", {}, Audience::Experts},
          {"lost_features", &P::lost_features, "", std::int64_t{8}, std::int64_t{4}, std::int64_t{1000}, {},
           "A frame with fewer accepted matches is LOST: its pose is predicted.",
           "docs/conventions.md", {}, Audience::Experts},
          {"degraded_features", &P::degraded_features, "", std::int64_t{20}, std::int64_t{4}, std::int64_t{1000}, {},
           "A frame with fewer accepted matches is DEGRADED.",
           "Tables 2 and 3: at least 37", {}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace swf_vo
