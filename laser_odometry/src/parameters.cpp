// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/parameters.hpp"

#include <cstdint>

namespace laser_odometry {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on a separate line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "laser_odometry",
      {
          {"cell", &P::cell, "m", 0.5, 0.1, 5.0, {},
           "Edge of the smallest cubes of the local map. Smaller is more accurate near surfaces and slower.",
           "laser_odometry/bench, accuracy"},
          {"levels", &P::levels, "", std::int64_t{3}, std::int64_t{1}, std::int64_t{6}, {},
           "Number of resolutions of the local map, each twice as coarse as the previous one.",
           "laser_odometry/bench, accuracy", {}, Audience::Experts},
          {"min_range", &P::min_range, "m", 0.5, 0.0, 100.0, {},
           "Returns nearer than this are dropped: the robot itself.", "docs/derivations/laser_odometry.md", {},
           Audience::Experts},
          {"max_range", &P::max_range, "m", 100.0, 1.0, 1000.0, {},
           "Returns further than this are dropped.", "docs/derivations/laser_odometry.md"},
          {"map_range", &P::map_range, "m", 100.0, 1.0, 1000.0, {},
           "Distance from the robot at which the local map ends; bounds its memory.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"deskew", &P::deskew, "", true, false, false, {},
           "Compensates the motion within a sweep if the times of its points are known.",
           "laser_odometry/bench, accuracy"},
          {"iterations", &P::iterations, "", std::int64_t{12}, std::int64_t{1}, std::int64_t{100}, {},
           "Maximum number of Gauss-Newton steps per round.", "docs/derivations/laser_odometry.md", {},
           Audience::Experts},
          {"rounds", &P::rounds, "", std::int64_t{2}, std::int64_t{1}, std::int64_t{10}, {},
           "Number of times a sweep is deskewed by the current motion estimate and registered again.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"surface_sigma", &P::surface_sigma, "m", 0.01, 0.001, 1.0, {},
           "Standard deviation common to a whole surface patch: unevenness, beam width, angle of incidence.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"acceleration", &P::acceleration, "m/s^2", 1.0, 0.01, 1000.0, {},
           "Standard deviation of the robot's acceleration: within a sweep, between sweeps, and without other "
           "information.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"angular_acceleration", &P::angular_acceleration, "rad/s^2", 0.5, 0.01, 1000.0, {},
           "Standard deviation of the robot's angular acceleration: sway, bumps, steering.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"lost_patches", &P::lost_patches, "", std::int64_t{30}, std::int64_t{6}, std::int64_t{100000}, {},
           "Minimum number of matched surface patches; with fewer, a sweep is LOST and its pose is that of the prior.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"degraded_patches", &P::degraded_patches, "", std::int64_t{100}, std::int64_t{6}, std::int64_t{100000}, {},
           "Number of matched surface patches below which a sweep is DEGRADED.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"planar_cell", &P::planar_cell, "m", 0.2, 0.05, 5.0, {}, "As cell, for planar lasers.",
           "laser_odometry/bench, planar", {}, Audience::Experts},
          {"planar_min_range", &P::planar_min_range, "m", 0.1, 0.0, 100.0, {}, "As min_range, for planar lasers.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"floor_height", &P::floor_height, "m", 0.01, 1e-4, 10.0, {},
           "Planar lasers: standard deviation of the floor's height after 1 m; grows with the root of the distance.",
           "docs/derivations/laser_odometry.md", {}, Audience::Experts},
          {"floor_tilt", &P::floor_tilt, "deg", 0.5, 0.01, 45.0, {},
           "Planar lasers: standard deviation of the robot's roll and pitch.", "docs/derivations/laser_odometry.md",
           {}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace laser_odometry
