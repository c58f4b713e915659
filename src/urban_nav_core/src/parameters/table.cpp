// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"

namespace urban_nav_core {
namespace {

double asNumber(const ParameterValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.base())) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value.base())) return *number;
  return std::numeric_limits<double>::quiet_NaN();
}

bool isPlainYaml(const std::string& text) {
  static const std::set<std::string> kMeaningful = {"true", "false", "null", "True", "False", "Null", "TRUE", "FALSE",
                                                    "NULL", "yes",   "no",   "Yes",  "No",    "YES",  "NO",   "y",
                                                    "n",    "Y",     "N",    "On",   "Off",   "ON",   "OFF"};
  const auto harmless = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '/';
  };
  const bool starts_with_letter =
      !text.empty() && harmless(text[0]) && text[0] != '-' && !(text[0] >= '0' && text[0] <= '9');
  return starts_with_letter && std::all_of(text.begin(), text.end(), harmless) && kMeaningful.count(text) == 0;
}

std::string quoted(const std::string& text) {
  if (isPlainYaml(text)) return text;
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (code < 0x20U || code == 0x7fU) {
      out += std::string("\\x") + kHex[code >> 4U] + kHex[code & 15U];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace

std::string fullName(const std::string& stage, const std::string& name) {
  return stage.empty() ? name : stage + "." + name;
}

std::string printValue(const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value.base())) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value.base())) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value.base())) return printNumber(*number);
  return quoted(std::get<std::string>(value));
}

std::string allowed(const RowInfo& row) {
  const std::string unit = row.unit.empty() ? "" : " (" + row.unit + ")";
  switch (row.type) {
    case ParameterType::Bool: return "true, false";
    case ParameterType::Word: return row.words.empty() ? "any text" : joined(row.words);
    case ParameterType::Integer:
    case ParameterType::Number: break;
  }
  return (row.type == ParameterType::Integer ? "" : "numbers ") + printValue(row.low) + "..." + printValue(row.high) +
         unit;
}

bool isAllowed(const RowInfo& row, const ParameterValue& value) {
  const bool whole = std::holds_alternative<std::int64_t>(value.base());
  switch (row.type) {
    case ParameterType::Bool: return std::holds_alternative<bool>(value.base());
    case ParameterType::Word: {
      const auto* word = std::get_if<std::string>(&value.base());
      return word != nullptr &&
             (row.words.empty() || std::find(row.words.begin(), row.words.end(), *word) != row.words.end());
    }
    case ParameterType::Integer: {
      const auto* number = std::get_if<std::int64_t>(&value.base());
      return number != nullptr && *number >= std::get<std::int64_t>(row.low) &&
             *number <= std::get<std::int64_t>(row.high);
    }
    case ParameterType::Number: {
      if (!whole && !std::holds_alternative<double>(value.base())) return false;
      const double number = asNumber(value);
      return number >= asNumber(row.low) && number <= asNumber(row.high);
    }
  }
  return false;
}

void assertSound([[maybe_unused]] const std::string& stage, const std::vector<RowInfo>& rows) {
  std::set<std::string> names;
  for (const RowInfo& row : rows) {
    [[maybe_unused]] const bool first_of_its_name = names.insert(row.name).second;
    assert(first_of_its_name && !row.name.empty() && !row.sentence.empty());
    assert(row.type != ParameterType::Integer || (std::holds_alternative<std::int64_t>(row.low.base()) &&
                                                  std::holds_alternative<std::int64_t>(row.high.base()) &&
                                                  std::get<std::int64_t>(row.high) <= std::numeric_limits<int>::max() &&
                                                  std::get<std::int64_t>(row.low) >= std::numeric_limits<int>::min()));
    assert(isAllowed(row, row.standard));
    assert(std::none_of(row.old_names.begin(), row.old_names.end(), [&](const std::string& old_name) {
      return std::any_of(rows.begin(), rows.end(),
                         [&](const RowInfo& other) { return other.name == old_name.substr(0, old_name.find(':')); });
    }));
  }
}

}  // namespace urban_nav_core
