// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/cloud_view.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace urban_nav_core {

/// Sweep of a cloud, with the faults found while reading.
struct ReadSweep {
  /// Whether the times of this cloud are used, or the reason why not.
  enum class Times {
    Used,
    None,        ///< none, according to the convention
    Constant,    ///< all equal
    Decreasing,  ///< the first point has the last time
    Span         ///< they span more than a sweep may take
  };

  Sweep sweep;              ///< without beams if no point can be used
  std::string fault;        ///< why the bytes cannot be read; empty: no fault
  std::size_t points = 0;   ///< in the cloud
  std::size_t invalid = 0;  ///< without finite coordinates, at the origin, or beyond the range of any LiDAR
  std::size_t near = 0;     ///< discarded because nearer than CloudOptions::nearest
  std::size_t untimed = 0;  ///< discarded because their time is outside the sweep
  std::size_t missing = 0;  ///< declared, but without bytes
  std::size_t rings = 0;    ///< number of rings with a beam
  Times times = Times::None;
  double clock = 0.0;  ///< s by which times were shifted to the clock of the headers; 0: not shifted
};

/// Converts clouds of one 3D LiDAR to sweeps. Thread-safe for reading.
class SweepReader {
 public:
  SweepReader(CloudConvention convention, CloudOptions options);

  /// Returns the sweep of a cloud. For any input, all numbers of a beam are finite, directions are unit vectors and
  /// stamps lie within a second of the reference.
  ReadSweep read(const CloudView& cloud) const;
  const CloudConvention& convention() const { return convention_; }

 private:
  CloudConvention convention_;
  CloudOptions options_;
};

/// Sorts beams by time, column and ring; stable.
void sortBeams(std::vector<Beam>& beams);

/// Returns the share of a revolution completed when a spinning sensor measures in this direction of its frame, 0...1. A
/// revolution begins and ends at -x. `is_clockwise`: seen from above.
double shareOfTurn(double x, double y, bool is_clockwise);

}  // namespace urban_nav_core
