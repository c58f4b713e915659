// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Returns the shortest text that is read back as the same double, independent of the locale. Used for all numbers in
/// files. The caller ensures that the value is finite; NaN and infinities print as "nan", "inf", "-inf", which
/// parseNumber() rejects.
std::string printNumber(double value);
/// Returns the shortest text that is read back as the same float, independent of the locale.
std::string printNumber(float value);
void appendNumber(std::string& text, double value);

/// Parses a decimal number that fills the whole text ("-1.5", "+2e-3", ".5"), independent of the locale. Empty for
/// anything else: blanks, hexadecimal, "nan", "inf", values beyond the range of double. Underflow gives zero.
std::optional<double> parseNumber(std::string_view text);
/// Parses an integer that fills the whole text; empty on overflow.
std::optional<std::int64_t> parseInteger(std::string_view text);

/// Splits a line at blanks and tabs (a trailing `\r` counts as blank); returns views of `line`.
std::vector<std::string_view> splitBlanks(std::string_view line);
/// Splits at separators and trims each part; empty parts are kept, so n separators give n + 1 parts.
std::vector<std::string_view> splitAt(std::string_view line, char separator);
/// Returns the text without blanks, tabs and `\r` at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace urban_nav_core
