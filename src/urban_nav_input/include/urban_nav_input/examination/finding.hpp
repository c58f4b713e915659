// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_input {

/// What a defect of an input concerns.
enum class FindingKind {
  Stamps,
  Pairs,
  Rectification,
  Depth,
  Calibration,
  Tf,
  Rates,
  Imu,
  Lasers,
  Gps,
  Wheels,
  Topics,
  SweepTimes,
  SweepOverlap,
  SweepGap,
  RingOrder,
  ClockApart,
  PointsInvalid,
  PointsFew,
  PointsNear
};
const char* toString(FindingKind kind);

/// A defect of an input.
struct Finding {
  FindingKind kind = FindingKind::Pairs;
  std::string text;       ///< what is wrong, with its numbers
  std::string remedy;     ///< what repairs it: an option, a command, or what to change on the robot
  bool unusable = false;  ///< nothing can be mapped while this is so
  /// Arguments of `map` that repair it on this recording; empty: only a new recording or a number of the user does.
  std::vector<std::string> options = {};
};

/// Returns the findings in what the reader of an input states in sentences (SourceInfo::notes, Source::closingFaults).
/// Sentences that state no defect give none.
std::vector<Finding> readerFindings(const std::vector<std::string>& sentences);
/// Returns the finding in an error that prevents an input from being opened or read.
Finding errorFinding(const std::string& error, const std::string& allowed);

}  // namespace urban_nav_input
