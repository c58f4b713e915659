// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/alog.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::atLine;
using urban_nav_core::parseInteger;
using urban_nav_core::parseNumber;
using urban_nav_core::parseStamp;
using urban_nav_core::trimmed;
using urban_nav_core::UserError;

constexpr std::size_t kLongestValue = 16U << 20U;

std::string_view takeWord(std::string_view& rest) {
  const std::size_t begin = std::min(rest.find_first_not_of(" \t"), rest.size());
  const std::size_t end = std::min(rest.find_first_of(" \t", begin), rest.size());
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

bool isVariable(std::string_view word) {
  const auto upper = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  return !word.empty() && word[0] >= 'A' && word[0] <= 'Z' && std::all_of(word.begin(), word.end(), upper);
}

// A line that begins with number, blank, upper-case name is a row; other lines continue the previous value.
std::optional<AlogRow> beginningOfRow(std::string_view line, int number) {
  std::string_view rest = line;
  const auto logged = parseStamp(takeWord(rest));
  const std::string_view variable = takeWord(rest);
  if (!logged || !isVariable(variable) || line.front() == ' ' || line.front() == '\t') return std::nullopt;
  AlogRow row;
  row.logged = *logged;
  row.variable = variable;
  row.source = takeWord(rest);
  row.value = trimmed(rest);
  row.line = number;
  return row;
}

}  // namespace

AlogReader::AlogReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
  if (!file_) throw UserError(path_, std::string("cannot be read: ") + std::strerror(errno), "");
}

bool AlogReader::readLine() {
  line_.clear();
  std::array<char, 1U << 16U> piece{};
  while (file_.getline(piece.data(), static_cast<std::streamsize>(piece.size())) || file_.gcount() > 0) {
    const bool whole = !file_.fail();
    auto count = static_cast<std::size_t>(file_.gcount());
    if (whole && !file_.eof()) --count;  // the end of the line counts
    line_.append(piece.data(), count);
    if (line_.size() > kLongestValue) throw UserError(atLine(path_, number_ + 1), "a line longer than 16 MB", "");
    if (whole) break;
    file_.clear(file_.rdstate() & ~std::ios::failbit);
    if (file_.eof()) break;
  }
  if (line_.empty() && !file_) return false;
  if (file_.bad()) throw UserError(path_, "cannot be read to its end", "");
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  ++number_;
  return true;
}

void AlogReader::comment() {
  constexpr std::string_view kStart = "LOGSTART";
  const std::size_t at = line_.find(kStart);
  if (at == std::string::npos) return;
  const auto stamp = parseStamp(trimmed(std::string_view(line_).substr(at + kStart.size())));
  if (!stamp) throw UserError(atLine(path_, number_), "LOGSTART without a time", "Unix seconds");
  log_start_ = stamp;
}

std::optional<AlogRow> AlogReader::next() {
  std::optional<AlogRow> row;
  while (has_line_ || readLine()) {
    has_line_ = false;
    if (line_.rfind("%%", 0) == 0) {
      comment();
      continue;
    }
    auto beginning = beginningOfRow(line_.empty() ? " " : line_, number_);
    if (beginning && row) {
      has_line_ = true;  // of the next row
      return row;
    }
    if (beginning) {
      row = std::move(beginning);
    } else if (row) {
      if (row->value.size() + line_.size() > kLongestValue)
        throw UserError(atLine(path_, row->line), "a value longer than 16 MB", "");
      row->value += "\n";
      row->value += trimmed(line_);
    } else if (!trimmed(line_).empty()) {
      throw UserError(atLine(path_, number_), "not a row of a MOOS log",
                      "`time VARIABLE source value`, or comments that begin with %%");
    }
  }
  return row;
}

AlogFields::AlogFields(std::string_view value, std::string where) : where_(std::move(where)) {
  std::size_t at = 0;
  while (at < value.size()) {
    int depth = 0;
    std::size_t end = at;
    while (end < value.size() && (value[end] != ',' || depth > 0)) {
      if (value[end] == '{') ++depth;
      if (value[end] == '}' && depth > 0) --depth;
      ++end;
    }
    const std::string_view piece = value.substr(at, end - at);
    const std::size_t equals = piece.find('=');
    if (equals != std::string_view::npos)
      fields_.emplace_back(trimmed(piece.substr(0, equals)), trimmed(piece.substr(equals + 1)));
    at = end + 1;
  }
}

bool AlogFields::has(std::string_view key) const {
  return std::any_of(fields_.begin(), fields_.end(), [key](const auto& field) { return field.first == key; });
}

std::string_view AlogFields::text(std::string_view key) const {
  for (const auto& [name, value] : fields_) {
    if (name == key) return value;
  }
  throw UserError(where_, "no field `" + std::string(key) + "`", "");
}

namespace {

// Larger numbers indicate damage: their squares overflow, their sines are meaningless.
constexpr double kLargestNumber = 1e12;
bool isSensible(const std::optional<double>& number) { return number && std::abs(*number) <= kLargestNumber; }

}  // namespace

double AlogFields::number(std::string_view key) const {
  const std::string_view value = text(key);
  const auto number = parseNumber(value);
  if (!isSensible(number)) throw UserError(where_, std::string(key) + " = " + std::string(value), "a finite number");
  return *number;
}

urban_nav_core::StampNs AlogFields::stamp(std::string_view key) const {
  const std::string_view value = text(key);
  const auto stamp = parseStamp(value);
  if (!stamp) throw UserError(where_, std::string(key) + " = " + std::string(value), "seconds");
  return *stamp;
}

std::vector<double> AlogFields::array(std::string_view key, std::size_t count) const {
  const std::string_view value = text(key);
  const auto refuse = [&](const std::string& what) {
    throw UserError(where_, std::string(key) + ": " + what, "[n]{v,v,...} or [rxc]{...}");
  };
  const std::size_t bracket = value.find(']'), open = value.find('{');
  if (value.empty() || value[0] != '[' || bracket == std::string_view::npos || open != bracket + 1 ||
      value.back() != '}') {
    refuse("incomplete array");
  }
  const std::string_view size = value.substr(1, bracket - 1);
  const std::size_t cross = size.find('x');
  const auto rows = parseInteger(size.substr(0, cross));
  const auto columns =
      cross == std::string_view::npos ? std::optional<std::int64_t>(1) : parseInteger(size.substr(cross + 1));
  constexpr std::int64_t kLargest = 1000000;
  if (!rows || !columns || *rows < 0 || *columns < 0 || *rows > kLargest || *columns > kLargest)
    refuse("size [" + std::string(size) + "]");

  std::string_view content = trimmed(value.substr(open + 1, value.size() - open - 2));
  if (!content.empty() && content.back() == ',') content.remove_suffix(1);
  std::vector<double> numbers;
  if (!content.empty()) {
    for (const std::string_view piece : urban_nav_core::splitAt(content, ',')) {
      const auto number = parseNumber(piece);
      if (!isSensible(number)) refuse("`" + std::string(piece) + "`");
      numbers.push_back(*number);
    }
  }
  if (static_cast<std::int64_t>(numbers.size()) != *rows * *columns) {
    refuse(std::to_string(numbers.size()) + " numbers in [" + std::string(size) + "]");
  }
  if (count != 0 && numbers.size() != count)
    refuse(std::to_string(numbers.size()) + " numbers instead of " + std::to_string(count));
  return numbers;
}

}  // namespace urban_nav_input
