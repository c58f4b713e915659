// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_core {

/// Conversion from message values to a scan.
struct LaserConvention {
  double range_scale = 1.0;  ///< m per unit of the ranges
  double angle_scale = 1.0;  ///< rad per unit of the angles
  StampNs delay = 0;         ///< ns by which stamps are later than the measurement of the first beam
  double time_scale = 1.0;   ///< s per unit of time_increment
};
/// Wrong unit of a laser scan.
enum class ScanFault {
  None,
  AngleUnit,  ///< more than a revolution: angles in degrees
  RangeUnit,  ///< ranges in millimetres or centimetres
};

/// Fault of a scan's units, and the scale that corrects it.
struct ScanVerdict {
  ScanFault fault = ScanFault::None;
  double value = 0.0;   ///< the span of the angles (rad as stated), or the median range (m as stated)
  double repair = 1.0;  ///< scale to be applied after the present one; 1: no known unit fits
};

/// Checks the units of a scan: beams over more than a revolution, or ranges beyond those of any planar laser. Ranges
/// are assessed by the median of the valid ones, if there are ten or more.
ScanVerdict checkUnits(const PlanarScan& scan);

}  // namespace urban_nav_core
