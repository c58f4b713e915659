// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"

namespace laser_mapper {

/// Sensor model of the mixed-pixel test.
struct MixedPixelModel {
  float range_sigma = 0.006F;  ///< m
  float roughness = 0.01F;     ///< m: roughness of real surfaces
  float min_jump = 0.03F;      ///< m: smaller steps in range are attributed to noise
};

/// Returns a flag per beam: 1 if its range lies between those of its neighbours, continues neither of the adjacent
/// surfaces, and does not lie on the line between them. Such a beam has hit two surfaces, and its end lies on neither
/// (Tuley et al. 2005). On a plane the inverse range is a sinusoid of the angle, so one beam is predicted by two
/// others. Beams without two neighbours on one side are tested on the other side only. Thread-safe.
std::vector<std::uint8_t> findMixedPixels(const urban_nav_core::Scan& scan, const MixedPixelModel& model);

}  // namespace laser_mapper
