// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace urban_nav_core {

/// Returns text that may hold names of other people's files (topics, frames, paths) as a terminal may show it: control
/// characters (ECMA-48, which can retitle a window, move the cursor or type), marks that turn the direction of writing,
/// and bytes that are no UTF-8 become "\x1b" and the like. Text without them is returned as it is. `keep`: control
/// characters that stay, such as "\n".
std::string printable(std::string_view text, std::string_view keep = "");

}  // namespace urban_nav_core
