// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/cloud_view.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace urban_nav_core {

/// A cloud read as a sweep, and what was wrong with it.
struct ReadSweep {
  /// Whether the times of this cloud are used, and why not.
  enum class Times {
    Used,
    None,        ///< by the convention
    Constant,    ///< all the same
    Decreasing,  ///< the first point has the last time
    Span         ///< they span more than a sweep can
  };

  Sweep sweep;              ///< without beams if no point can be used
  std::string fault;        ///< why the bytes cannot be read; empty: they can
  std::size_t points = 0;   ///< of the cloud
  std::size_t invalid = 0;  ///< without a finite place, at the origin, or farther than any LiDAR measures
  std::size_t near = 0;     ///< left out because they are nearer than CloudOptions::nearest
  std::size_t untimed = 0;  ///< left out because their time is not within the sweep
  std::size_t missing = 0;  ///< announced, but without bytes
  std::size_t rings = 0;    ///< that have a beam
  Times times = Times::None;
  double clock = 0.0;  ///< s by which times were moved to the clock of the headers; 0: none
};

/// Reads clouds of one 3D LiDAR as sweeps. Reading is safe from several threads.
class SweepReader {
 public:
  SweepReader(CloudConvention convention, CloudOptions options);

  /// Returns the sweep of a cloud. Whatever its bytes: no number of a beam is NaN, directions are unit vectors, stamps
  /// lie within a second of the reference.
  ReadSweep read(const CloudView& cloud) const;
  const CloudConvention& convention() const { return convention_; }

 private:
  CloudConvention convention_;
  CloudOptions options_;
};

/// Puts beams into the order of time, then of column and ring; those that are equal stay as they are.
void sortBeams(std::vector<Beam>& beams);

/// Returns the share of a turn that a spinning sensor has completed when it measures in a direction of its frame,
/// 0...1. The turn begins and ends backwards (-x); it is clockwise seen from above, or not.
double shareOfTurn(double x, double y, bool is_clockwise);

}  // namespace urban_nav_core
