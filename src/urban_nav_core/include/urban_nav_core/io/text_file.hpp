// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// Returns the bytes of a file. Throws UserError naming the path if it is missing, a folder, or cannot be read to its
/// end.
std::string readBytes(const std::string& path);

/// Returns the text of a file in UTF-8, converted by decodeText(). Throws UserError as readBytes() does.
std::string readTextFile(const std::string& path);

/// Converts UTF-8 or UTF-16 (either byte order, with or without a byte order mark) to UTF-8 without the mark. Other
/// bytes, such as Latin-1, are returned unchanged.
std::string decodeText(std::string bytes);

/// Calls `line(text, number)` for every line, counted from 1, without its line end: `\n`, `\r\n`, or `\r` in a text
/// without `\n`. A last line without a line end is included.
void forEachLine(std::string_view text, const std::function<void(std::string_view line, int number)>& line);

}  // namespace urban_nav_core
