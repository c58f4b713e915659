// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/cloud_convention.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

void CloudConvention::archive(Archive& archive) {
  archive(times, fault, suspect, middle, clock, sweep_s, rings, ring_field, order, elevations, are_rings_known,
          are_rings_sorted, absent_rings, ring_count, columns, is_clockwise, intensity_field, intensity_scale, clouds);
  constexpr std::size_t kMost = 65535;
  archive.require(fault <= PointTimesFault::Clock && rings <= Rings::Elevation && ring_count >= 1 &&
                      ring_count <= kMost && columns >= 1 && columns <= kMost && elevations.size() < ring_count + 1,
                  "an unknown cloud convention");
  constexpr double kMostSeconds = 1e6;
  archive.require(times.unit <= PointTimes::Unit::Nanoseconds && times.reference <= PointTimes::Reference::Absolute,
                  "an unknown unit");
  archive.require(std::abs(middle) <= 1.0 && sweep_s >= 0.0 && sweep_s <= kMostSeconds, "unknown times");
  archive.require(std::is_sorted(elevations.begin(), elevations.end()) &&
                      std::all_of(order.begin(), order.end(), [this](std::uint16_t ring) { return ring < ring_count; }),
                  "unknown rings");
}

}  // namespace urban_nav_core
