// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// One topic of a bag or one stream of a folder, by the times at which its messages were received.
struct StreamInfo {
  std::string name, type;
  std::int64_t messages = 0;
  urban_nav_core::StampNs first = 0, last = 0;
  double rate_hz = 0.0;        ///< mean; 0 for fewer than two messages
  double longest_gap_s = 0.0;  ///< between neighbours
  std::string undecoded;       ///< reason why messages of a recording cannot be decoded; empty: they can
  std::int64_t backward = 0;   ///< stamps of a folder that are not later than the previous one
};
/// Streams and extent of a recording.
struct InputInfo {
  std::string name, kind;
  std::vector<StreamInfo> streams;
  std::optional<double> distance_m;  ///< along wheel odometry or truth
  std::string distance_of;           ///< source of the distance
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< damage of a recording, with its place
};

/// Returns the contents of a bag or folder. Throws DataError if it cannot be read.
InputInfo lookInto(const std::string& path);

}  // namespace urban_nav_input
