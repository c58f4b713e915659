// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/print.hpp"

#include <algorithm>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kWidth = 110;
constexpr const char* kHelpIndent = "      ";

// Wraps prose to the line length, each line with its indent. `first`: indent of the first line, if different.
std::string wrapped(const std::string& prose, const std::string& beginning, const std::string& first = "") {
  std::string out, line = first.empty() ? beginning : first;
  std::size_t at = 0;
  while (at < prose.size()) {
    const std::size_t end = std::min(prose.find(' ', at), prose.size());
    const std::string word = prose.substr(at, end - at);
    const bool empty = line == beginning;
    if (!empty && line.size() + 1 + word.size() > kWidth) {
      out += line + "\n";
      line = beginning + word;
    } else {
      line += (empty ? "" : " ") + word;
    }
    at = end + 1;
  }
  return out + line + "\n";
}

std::string formatRange(const RowInfo& row) {
  return row.type == ParameterType::Integer || row.type == ParameterType::Number
             ? printValue(row.low) + "..." + printValue(row.high)
             : allowed(row);
}

std::string described(const RowInfo& row) {
  std::string text = row.sentence + " Allowed: " + allowed(row) + ".";
  if (!row.source.empty()) text += " [" + row.source + "]";
  return text;
}

const Setting* find(const std::vector<Setting>& settings, const std::string& name) {
  const auto it =
      std::find_if(settings.begin(), settings.end(), [&name](const Setting& each) { return each.name == name; });
  return it == settings.end() ? nullptr : &*it;
}

// Escapes pipes, which would end the cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return " " + out + " |";
}

// Returns the table of the rows for an audience; empty without such rows.
std::string markdownTable(const std::string& stage, const std::vector<RowInfo>& rows, Audience audience) {
  std::string out;
  for (const RowInfo& row : rows) {
    if (row.audience != audience) continue;
    out += "|" + cell("`" + fullName(stage, row.name) + "`") + cell("`" + printValue(row.standard) + "`") +
           cell(row.unit) + cell(formatRange(row)) + cell(row.sentence) + cell(row.source) + "\n";
  }
  const std::string head = audience == Audience::Users
                               ? "| parameter | default | unit | allowed | what it does | source |"
                               : "|parameter|default|unit|allowed|what it does|source|";
  return out.empty() ? "" : head + "\n|---|---|---|---|---|---|\n" + out;
}

// Returns "  swf_vo.window = 25  (--set swf_vo.window=25)".
std::string valueLine(const std::string& stage, const RowInfo& row, const std::vector<Setting>& settings) {
  const Setting* setting = find(settings, row.name);
  return "  " + fullName(stage, row.name) + " = " + printValue(setting != nullptr ? setting->value : row.standard) +
         "  (" + (setting != nullptr ? setting->origin : "default") + ")";
}

}  // namespace

std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows) { return printYaml(stage, rows, {}); }

namespace {

/// Returns a value for YAML 1.1, in which 1e-05 is a string and 1.0e-05 a number.
std::string yamlValue(const ParameterValue& value) {
  std::string text = printValue(value);
  if (!std::holds_alternative<double>(value.base()) || text.find('.') != std::string::npos) return text;
  const std::size_t exponent = text.find('e');
  return exponent == std::string::npos ? text : text.insert(exponent, ".0");
}

}  // namespace

std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows,
                      const std::vector<Setting>& settings) {
  const std::string indent = stage.empty() ? "" : "  ";
  std::string out = stage.empty() ? "" : stage + ":\n";
  for (const RowInfo& row : rows) {
    const Setting* setting = find(settings, row.name);
    out += wrapped(described(row), indent + "# ");
    out += indent + row.name + ": " + yamlValue(setting != nullptr ? setting->value : row.standard);
    if (setting != nullptr) out += "  # " + setting->origin;
    out += "\n";
  }
  return out;
}

std::string printMarkdown(const std::string& stage, const std::vector<RowInfo>& rows) {
  const std::string for_users = markdownTable(stage, rows, Audience::Users);
  const std::string for_experts = markdownTable(stage, rows, Audience::Experts);
  if (for_experts.empty()) return for_users;
  const std::string title = "<details><summary>Parameters for experts</summary>\n\n", end = "\n</details>\n";
  return for_users + (for_users.empty() ? "" : "\n") + title + for_experts + end;
}

std::string printHelp(const std::string& stage, const std::vector<RowInfo>& rows,
                      const std::vector<Setting>& settings) {
  std::string out;
  for (const RowInfo& row : rows)
    if (row.audience == Audience::Users)
      out += wrapped(row.sentence, kHelpIndent, valueLine(stage, row, settings) + ":");
  return out;
}

std::string printHelpForExperts(const std::string& stage, const std::vector<RowInfo>& rows,
                                const std::vector<Setting>& settings) {
  std::string out;
  for (const RowInfo& row : rows) out += valueLine(stage, row, settings) + "\n" + wrapped(described(row), kHelpIndent);
  return out;
}

std::string insertMarkdown(const std::string& readme, const std::string& path, const std::string& stage,
                           const std::vector<RowInfo>& rows) {
  const std::string opening = "<!-- parameters: " + stage + " -->";
  const std::string closing = "<!-- end -->";
  const std::size_t begin = readme.find(opening);
  const std::size_t end = begin == std::string::npos ? begin : readme.find(closing, begin);
  if (end == std::string::npos) {
    throw UserError(path, "no markers for the table of parameters", "`" + opening + "` ... `" + closing + "`");
  }
  return readme.substr(0, begin + opening.size()) + "\n" + printMarkdown(stage, rows) + readme.substr(end);
}

}  // namespace urban_nav_core
