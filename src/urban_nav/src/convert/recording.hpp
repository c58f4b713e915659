// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "convert/convert.hpp"

namespace urban_nav {

/// Part of a recording that is converted.
struct RecordingPart {
  std::vector<std::string> topics;  ///< empty: all
  std::optional<double> from, to;   ///< s after the first message, by receipt; `from` is included, `to` is not
  std::optional<double> split;      ///< MB of a file, after which the next one begins
};

/// Converts a recording of any storage to a ROS 1 bag (OUTPUT.bag) or MCAP (OUTPUT.mcap), or with `split` to OUTPUT_0,
/// OUTPUT_1, ..., each complete in itself. Messages come in the order of their receipt. What cannot be decoded keeps
/// its bytes in MCAP, and is left out of a bag and noted. Throws UserError for a topic that is absent and for another
/// ending, DataError if nothing can be written.
Converted convertRecording(const std::string& input, const std::string& output, const RecordingPart& part,
                           Console& console);

}  // namespace urban_nav
