// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace urban_nav_core {

/// Escapes text from external files (topics, frames, paths) for a terminal: control characters (ECMA-48, which can
/// retitle a window, move the cursor or type), bidirectional marks, and bytes that are not UTF-8 become `\x1b` and
/// similar. Other text is returned unchanged. `keep`: control characters that are not escaped, such as `\n`.
std::string printable(std::string_view text, std::string_view keep = "");

}  // namespace urban_nav_core
