// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// One beam of a laser: what every consumer works with. Nothing outside laser/ knows how a device turns its mirror.
struct Beam {
  StampNs stamp = 0;                                     ///< when this beam was measured
  Eigen::Vector3f direction = Eigen::Vector3f::UnitX();  ///< unit vector in the laser's frame
  float range = 0.0F;                                    ///< m; a beam without a valid range is not in a Scan
  float intensity = 0.0F;                                ///< 0...255
  std::uint16_t ring = 0;    ///< 3D LiDARs: which of the lasers, counted from the lowest elevation; planar scanners: 0
  std::uint16_t column = 0;  ///< 3D LiDARs: which firing of the sweep, in order of time; planar scanners: 0
};

/// The beams of one turn of the mirror that have a valid range, in order of time.
struct Scan {
  StampNs stamp = 0;  ///< of the first beam of the turn, valid or not
  std::vector<Beam> beams;
};

/// A turn of a planar scanner as its driver, a bag or a log has it: equally spaced angles in the x-y plane of the
/// laser's frame, from the x axis towards the y axis. Equal numbers of ranges and intensities, or no intensities.
struct PlanarScan {
  StampNs stamp = 0;         ///< first beam
  double angle_first = 0.0;  ///< rad
  double angle_step = 0.0;   ///< rad from beam to beam; negative: clockwise
  double time_step = 0.0;    ///< s from beam to beam
  double period = 0.0;       ///< s from turn to turn
  double range_min = 0.0;  ///< m; ranges outside range_min...range_max are not valid, nor are those that are not finite
  double range_max = 0.0;  ///< m
  std::vector<float> ranges;  ///< m; values <= 0 or NaN: no valid range
  std::vector<float> intensities;
};

/// The valid beams; an intensity that is not finite is 0.
Scan toScan(const PlanarScan& scan);

/// Same stamps and numbers of beams, and every number within `tolerance`; ranges that are not valid equal each other.
bool isApprox(const PlanarScan& a, const PlanarScan& b, double tolerance);
bool isApprox(const Scan& a, const Scan& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const PlanarScan& scan);
std::ostream& operator<<(std::ostream& out, const Scan& scan);

}  // namespace urban_nav_core
