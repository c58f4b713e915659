// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/print.hpp"

#include <algorithm>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kWidth = 110;

// Breaks prose at blanks so that each line with its beginning fits.
std::string wrapped(const std::string& prose, const std::string& beginning) {
  std::string out, line = beginning;
  std::size_t at = 0;
  while (at < prose.size()) {
    const std::size_t end = std::min(prose.find(' ', at), prose.size());
    const std::string word = prose.substr(at, end - at);
    const bool empty = line.size() == beginning.size();
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

// A pipe would end the cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return " " + out + " |";
}

}  // namespace

std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows) { return printYaml(stage, rows, {}); }

std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows,
                      const std::vector<Setting>& settings) {
  const std::string indent = stage.empty() ? "" : "  ";
  std::string out = stage.empty() ? "" : stage + ":\n";
  for (const RowInfo& row : rows) {
    const Setting* setting = find(settings, row.name);
    out += wrapped(described(row), indent + "# ");
    out += indent + row.name + ": " + printValue(setting != nullptr ? setting->value : row.standard);
    if (setting != nullptr) out += "  # " + setting->origin;
    out += "\n";
  }
  return out;
}

std::string printMarkdown(const std::string& stage, const std::vector<RowInfo>& rows) {
  std::string out = "| parameter | default | unit | allowed | what it does | source |\n|---|---|---|---|---|---|\n";
  for (const RowInfo& row : rows) {
    out += "|" + cell("`" + fullName(stage, row.name) + "`") + cell("`" + printValue(row.standard) + "`") +
           cell(row.unit) + cell(formatRange(row)) + cell(row.sentence) + cell(row.source) + "\n";
  }
  return out;
}

std::string printHelp(const std::string& stage, const std::vector<RowInfo>& rows,
                      const std::vector<Setting>& settings) {
  std::string out;
  for (const RowInfo& row : rows) {
    const Setting* setting = find(settings, row.name);
    out += "  " + fullName(stage, row.name) + " = " + printValue(setting != nullptr ? setting->value : row.standard) +
           "  (" + (setting != nullptr ? setting->origin : "default") + ")\n" + wrapped(described(row), "      ");
  }
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
