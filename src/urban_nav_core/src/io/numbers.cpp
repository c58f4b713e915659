// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/numbers.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace urban_nav_core {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// std::from_chars rejects a plus sign and accepts "nan" and "inf".
bool isDecimalText(std::string_view text) {
  bool digit = false;
  for (const char c : text) {
    digit = digit || (c >= '0' && c <= '9');
    if ((c < '0' || c > '9') && c != '.' && c != '-' && c != '+' && c != 'e' && c != 'E') return false;
  }
  return digit;
}

std::string_view withoutPlus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

// A number out of range is an underflow if its exponent is negative, or if it has none and begins with a zero.
bool isUnderflow(std::string_view text) {
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string_view::npos) return e + 1 < text.size() && text[e + 1] == '-';
  const std::size_t first = text.find_first_not_of("-0");
  return first == std::string_view::npos || text[first] == '.';
}

#if defined(__cpp_lib_to_chars) && __cpp_lib_to_chars >= 201611L

template <typename Real>
std::string shortest(Real value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return std::string(buffer, end.ptr);
}

std::optional<double> decimal(std::string_view text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ptr != text.data() + text.size()) return std::nullopt;
  if (end.ec == std::errc::result_out_of_range && isUnderflow(text)) return 0.0;
  if (end.ec != std::errc()) return std::nullopt;
  return value;
}

#else  // GCC 9 and 10 have no to_chars for floating point

std::optional<double> decimal(std::string_view text) {
  std::istringstream in{std::string(text)};
  in.imbue(std::locale::classic());
  double value = 0.0;
  in >> value;
  const bool read_all = in.eof() || in.peek() == std::istringstream::traits_type::eof();
  if (!read_all) return std::nullopt;
  if (in.fail()) return isUnderflow(text) && std::abs(value) < 1.0 ? std::optional<double>(0.0) : std::nullopt;
  return value;
}

template <typename Real>
std::string shortest(Real value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  std::string text;
  for (int digits = 1; digits <= std::numeric_limits<Real>::max_digits10; ++digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(digits);
    out << value;
    text = out.str();
    const auto back = decimal(text);
    if (back && static_cast<Real>(*back) == value) break;
  }
  return text;
}

#endif

}  // namespace

std::string printNumber(double value) { return shortest(value); }
std::string printNumber(float value) { return shortest(value); }
void appendNumber(std::string& text, double value) { text += shortest(value); }

std::optional<double> parseNumber(std::string_view text) {
  if (!isDecimalText(text)) return std::nullopt;
  const auto value = decimal(withoutPlus(text));
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return *value;
}

std::optional<std::int64_t> parseInteger(std::string_view text) {
  const std::string_view digits = withoutPlus(text);
  std::int64_t value = 0;
  const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end.ec != std::errc() || end.ptr != digits.data() + digits.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> splitBlanks(std::string_view line) {
  std::vector<std::string_view> pieces;
  std::size_t at = 0;
  while (at < line.size()) {
    while (at < line.size() && isBlank(line[at])) ++at;
    const std::size_t begin = at;
    while (at < line.size() && !isBlank(line[at])) ++at;
    if (at > begin) pieces.push_back(line.substr(begin, at - begin));
  }
  return pieces;
}

std::vector<std::string_view> splitAt(std::string_view line, char separator) {
  std::vector<std::string_view> pieces;
  std::size_t begin = 0;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && line[at] != separator) continue;
    pieces.push_back(trimmed(line.substr(begin, at - begin)));
    begin = at + 1;
  }
  return pieces;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace urban_nav_core
