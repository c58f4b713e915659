// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/sources.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "parameters/removed_names.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/yaml.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

// Returns the Levenshtein distance: insertions, deletions and substitutions between two names.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1U, row[j - 1] + 1U, substituted});
    }
  }
  return row[b.size()];
}

std::string nearest(const std::string& wanted, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 100;  // longer names are not compared: the cost is the product of the lengths
  const std::string head = wanted.substr(0, kLongest);
  const auto closer = [&head](const std::string& a, const std::string& b) {
    return editDistance(head, a) < editDistance(head, b);
  };
  const auto best = std::min_element(known.begin(), known.end(), closer);
  return best == known.end() ? "" : *best;
}

std::vector<std::string> listNames(const std::vector<RowInfo>& rows) {
  std::vector<std::string> names;
  for (const RowInfo& row : rows) names.push_back(row.name);
  return names;
}

std::optional<ParameterValue> readText(const RowInfo& row, const std::string& text) {
  switch (row.type) {
    case ParameterType::Bool:
      if (text == "true" || text == "false") return ParameterValue(text == "true");
      return std::nullopt;
    case ParameterType::Integer:
      if (const auto whole = parseInteger(text)) return ParameterValue(*whole);
      return std::nullopt;
    case ParameterType::Number:
      if (const auto number = parseNumber(text)) return ParameterValue(*number);
      return std::nullopt;
    case ParameterType::Word: return ParameterValue(text);
  }
  return std::nullopt;
}

// YAML parsers, including that of the parameter server, convert the words on and off to booleans.
ParameterValue wordForFlag(const RowInfo& row, const ParameterValue& value) {
  const auto* flag = std::get_if<bool>(&value.base());
  if (row.type != ParameterType::Word || flag == nullptr) return value;
  return *flag ? "on" : "off";
}

ParameterValue checked(const RowInfo& row, const Assignment& assignment) {
  const auto value = assignment.is_text ? readText(row, std::get<std::string>(assignment.value))
                                        : std::optional<ParameterValue>(wordForFlag(row, assignment.value));
  if (value && isAllowed(row, *value)) return *value;
  const std::string found = assignment.is_text ? std::get<std::string>(assignment.value) : printValue(assignment.value);
  throw UserError(assignment.where, fullName(assignment.stage, assignment.name) + " = " + found,
                  "allowed " + allowed(row));
}

void append(std::vector<Assignment>& assignments, const std::string& stage, const YamlNode& rows,
            const std::string& file) {
  std::set<std::string> seen;
  for (const auto& [key, node] : rows.map) {
    const std::string where = atLine(file, node.line);
    const std::string full = fullName(stage, key);
    if (node.kind != YamlNode::Kind::Scalar)
      throw UserError(where, full + " is not a single value", "one value after the colon");
    if (!seen.insert(key).second) throw UserError(where, "duplicate key " + full, "");
    assignments.push_back({stage, key, node.scalar, true, where});
  }
}

std::vector<Assignment> fromYaml(const YamlNode& root, const std::string& file) {
  std::vector<Assignment> assignments;
  if (root.kind == YamlNode::Kind::Null) return assignments;
  if (root.kind != YamlNode::Kind::Map)
    throw UserError(atLine(file, root.line), "no map of stages", "lines such as `swf_vo:`");
  YamlNode without_stage;
  std::set<std::string> seen;
  for (const auto& [stage, node] : root.map) {
    if (!seen.insert(stage).second) throw UserError(atLine(file, node.line), "duplicate key " + stage, "");
    if (node.kind == YamlNode::Kind::Map) {
      append(assignments, stage, node, file);
    } else if (node.kind != YamlNode::Kind::Null) {
      without_stage.map.emplace_back(stage, node);
    }
  }
  append(assignments, "", without_stage, file);
  return assignments;
}

}  // namespace

std::vector<Assignment> readParameters(const std::string& path) { return fromYaml(readYaml(path), path); }

std::vector<Assignment> parseParameters(std::string_view text, const std::string& name) {
  return fromYaml(parseYaml(text, name), name);
}

Assignment parseSetting(const std::string& text) {
  const std::string where = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw UserError(where, "no key and value", "stage.key=value");
  const std::string key(trimmed(std::string_view(text).substr(0, equals)));
  const std::string value(trimmed(std::string_view(text).substr(equals + 1)));
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos) return {"", key, value, true, where};
  return {key.substr(0, dot), key.substr(dot + 1), value, true, where};
}

std::vector<Assignment> serverParameters(const std::string& stage, const std::map<std::string, ParameterValue>& values,
                                         const std::string& name_space) {
  std::vector<Assignment> assignments;
  for (const auto& [name, value] : values) assignments.push_back({stage, name, value, false, name_space + "/" + name});
  return assignments;
}

std::vector<Setting> resolve(const std::string& stage, const std::vector<RowInfo>& rows,
                             const std::vector<Assignment>& assignments) {
  std::vector<Setting> settings;
  for (const RowInfo& row : rows) settings.push_back({stage, row.name, row.standard, "default"});
  for (const Assignment& assignment : assignments) {
    if (assignment.stage != stage) continue;
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const RowInfo& each) { return each.name == assignment.name; });
    if (row == rows.end()) {
      const std::string full_name = fullName(stage, assignment.name), replacement = findReplacement(full_name);
      if (!replacement.empty()) throw UserError(assignment.where, full_name + " was removed: " + replacement, "");
      throw UserError(assignment.where, full_name + " is not a parameter",
                      "the parameters that --help-all lists; "
                      "nearest: " +
                          fullName(stage, nearest(assignment.name, listNames(rows))));
    }
    Setting& setting = settings[static_cast<std::size_t>(row - rows.begin())];
    setting.value = checked(*row, assignment);
    setting.origin = assignment.where;
  }
  return settings;
}

void refuseUnknownStages(const std::vector<Assignment>& assignments, const std::vector<std::string>& stages) {
  for (const Assignment& assignment : assignments) {
    if (std::find(stages.begin(), stages.end(), assignment.stage) != stages.end()) continue;
    std::string known;
    for (const std::string& stage : stages)
      known += (known.empty() ? "" : ", ") + (stage.empty() ? std::string("none") : stage);
    const std::string found =
        assignment.stage.empty() ? assignment.name + " has no stage prefix" : assignment.stage + " is not a stage";
    throw UserError(assignment.where, found, known + "; nearest: " + nearest(assignment.stage, stages));
  }
}

}  // namespace urban_nav_core
