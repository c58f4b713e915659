// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// The whole file, without a byte order mark. Throws UserError naming the path if it is missing, a folder, or cannot be
/// read to its end.
std::string readTextFile(const std::string& path);

/// Calls `line(text, number)` for every line, counted from 1, without its end (\n or \r\n); a last line without an end
/// counts too.
void forEachLine(std::string_view text, const std::function<void(std::string_view line, int number)>& line);

}  // namespace urban_nav_core
