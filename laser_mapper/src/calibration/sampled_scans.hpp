// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "laser_mapper/parameters.hpp"
#include "mounted_laser.hpp"

namespace laser_mapper {

/// Subset of the beams of an interval that suffices for calibration.
struct SampledScans {
  struct Scan {
    urban_nav_core::StampNs middle = 0;  ///< as stamped
    std::uint8_t laser = 0;              ///< index in the list of lasers
    std::uint32_t window = 0;            ///< integer seconds since `begin`
    std::uint32_t first = 0, last = 0;   ///< beams first...last - 1
  };
  struct Beam {
    Eigen::Vector3f ray = Eigen::Vector3f::Zero();  ///< m, in the laser's frame
    float seconds = 0.0F;                           ///< since the middle of the scan
    std::uint32_t scan = 0;
  };
  urban_nav_core::StampNs begin = 0, end = 0;
  std::vector<Scan> scans;  ///< by window, then laser, then time
  std::vector<Beam> beams;  ///< by scan
};

/// Returns every second usable beam of scans at least 40 ms apart, with begin <= stamp < end.
SampledScans sampleScans(const Parameters& parameters, urban_nav_store::Store& store,
                         const urban_nav_store::SessionId& session, const std::vector<MountedLaser>& lasers,
                         urban_nav_core::StampNs begin, urban_nav_core::StampNs end);

}  // namespace laser_mapper
