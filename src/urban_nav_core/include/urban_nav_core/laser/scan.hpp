// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// One beam of a laser, the common representation outside laser/, independent of the device's mirror geometry.
struct Beam {
  StampNs stamp = 0;                                     ///< time of measurement
  Eigen::Vector3f direction = Eigen::Vector3f::UnitX();  ///< unit vector in the laser's frame
  float range = 0.0F;                                    ///< m; a Scan holds only beams with a valid range
  float intensity = 0.0F;                                ///< 0...255
  std::uint16_t ring = 0;    ///< 3D LiDARs: index of the laser, lowest elevation first; planar scanners: 0
  std::uint16_t column = 0;  ///< 3D LiDARs: index of the firing in the sweep, in order of time; planar scanners: 0
};

/// Beams with a valid range of one revolution of the mirror, in order of time.
struct Scan {
  StampNs stamp = 0;  ///< first beam of the revolution, valid or not
  std::vector<Beam> beams;
};

/// Revolution of a planar scanner in the form of its driver, a bag or a log: equally spaced angles in the x-y plane of
/// the laser's frame, from the x axis towards the y axis. Intensities are as many as ranges, or absent.
struct PlanarScan {
  StampNs stamp = 0;          ///< first beam
  double angle_first = 0.0;   ///< rad
  double angle_step = 0.0;    ///< rad from beam to beam; negative: clockwise
  double time_step = 0.0;     ///< s from beam to beam
  double period = 0.0;        ///< s from revolution to revolution
  double range_min = 0.0;     ///< m; ranges outside range_min...range_max or not finite are invalid
  double range_max = 0.0;     ///< m
  std::vector<float> ranges;  ///< m; values <= 0 or NaN: invalid
  std::vector<float> intensities;
};

/// Returns the beams with valid ranges; an intensity that is not finite becomes 0.
Scan toScan(const PlanarScan& scan);

/// Returns whether stamps and numbers of beams are equal and all numbers agree within `tolerance`; invalid ranges are
/// equal to each other.
bool isApprox(const PlanarScan& a, const PlanarScan& b, double tolerance);
bool isApprox(const Scan& a, const Scan& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const PlanarScan& scan);
std::ostream& operator<<(std::ostream& out, const Scan& scan);

}  // namespace urban_nav_core
