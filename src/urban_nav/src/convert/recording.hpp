// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "convert/convert.hpp"

namespace urban_nav {

/// Part of a recording to convert.
struct RecordingPart {
  std::vector<std::string> topics;  ///< empty: all
  std::optional<double> from, to;   ///< s after the first message, by receipt; `from` is included, `to` is not
  std::optional<double> split;      ///< MB per file
};

/// Converts a recording of any storage to a ROS 1 bag (OUTPUT.bag) or MCAP (OUTPUT.mcap), or with `split` to OUTPUT_0,
/// OUTPUT_1, ..., each complete. Messages are in the order of receipt. Messages that cannot be decoded are copied
/// unchanged to MCAP, and omitted from a bag with a note. Throws UserError for an absent topic or another extension,
/// DataError if no message can be written.
Converted convertRecording(const std::string& input, const std::string& output, const RecordingPart& part,
                           Console& console);

}  // namespace urban_nav
