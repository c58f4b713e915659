// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// The one way in which a number gets into a file: the shortest text that reads back as the same double, whatever the
/// locale. The caller sees to it that the value is finite; NaN and infinities print as "nan", "inf", "-inf", which
/// parseNumber refuses.
std::string printNumber(double value);
/// The same for single precision: the shortest text that reads back as the same float.
std::string printNumber(float value);
void appendNumber(std::string& text, double value);

/// A decimal number that fills the whole text ("-1.5", "+2e-3", ".5"), whatever the locale. Empty for anything else:
/// blanks, hexadecimal, "nan", "inf", values beyond a double's range. A value too small for a double is zero.
std::optional<double> parseNumber(std::string_view text);
/// A whole number that fills the text and fits.
std::optional<std::int64_t> parseInteger(std::string_view text);

/// The pieces of a line between blanks and tabs (a trailing \r counts as blank); views into `line`.
std::vector<std::string_view> splitBlanks(std::string_view line);
/// The pieces between separators, empty ones included, without blanks around them: n separators give n + 1 pieces.
std::vector<std::string_view> splitAt(std::string_view line, char separator);
/// Without blanks, tabs and \r at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace urban_nav_core
