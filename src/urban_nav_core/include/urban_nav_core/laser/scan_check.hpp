// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_core {

/// Conversion from the numbers of messages to a scan.
struct LaserConvention {
  double range_scale = 1.0;  ///< m per unit of the ranges
  double angle_scale = 1.0;  ///< rad per unit of the angles
  StampNs delay = 0;         ///< ns by which messages are stamped later than their first beam was measured
  double time_scale = 1.0;   ///< s per unit of time_increment
};

enum class ScanFault {
  None,
  AngleUnit,  ///< more than a turn: angles in degrees
  RangeUnit,  ///< ranges in millimetres or centimetres
};

/// Fault of the numbers of a scan, and the scale that repairs it.
struct ScanVerdict {
  ScanFault fault = ScanFault::None;
  double value = 0.0;   ///< the span of the angles (rad as stated), or the median range (m as stated)
  double repair = 1.0;  ///< scale to be applied after the present one; 1: none fits
};

/// Returns what is wrong with the units of a scan: beams over more than a turn, or ranges no planar laser has. Ranges
/// are assessed by the median of those that are valid, if there are ten or more.
ScanVerdict checkUnits(const PlanarScan& scan);

}  // namespace urban_nav_core
