// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_input {

/// Kind of a defect of an input.
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
  std::string text;       ///< description with figures
  std::string remedy;     ///< an option, a command, or a change on the robot
  bool unusable = false;  ///< the session cannot be mapped with this defect
  /// Arguments of `map` that repair this recording; empty if a new recording or a number of the user is needed.
  std::vector<std::string> options = {};
};

/// Returns the findings in sentences of the reader of an input (SourceInfo::notes, Source::closingFaults). Sentences
/// without a defect give none.
std::vector<Finding> readerFindings(const std::vector<std::string>& sentences);
/// Returns the finding for an error on opening or reading an input.
Finding errorFinding(const std::string& error, const std::string& allowed);

}  // namespace urban_nav_input
