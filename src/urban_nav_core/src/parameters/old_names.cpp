// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/old_names.hpp"

#include <algorithm>
#include <map>

namespace urban_nav_core {
namespace {

/// "loop_metric.queue" of either form of an old name.
std::string fullOldName(const std::string& stage, const std::string& old_name) {
  return old_name.find('.') == std::string::npos ? fullName(stage, old_name) : old_name;
}

struct PresentKey {
  std::string stage, name;
};

std::map<std::string, PresentKey> presentKeys(const std::vector<StageRows>& tables) {
  std::map<std::string, PresentKey> keys;
  for (const StageRows& table : tables)
    for (const RowInfo& row : table.rows)
      for (const std::string& old_name : row.old_names)
        keys.emplace(fullOldName(table.stage, old_name), PresentKey{table.stage, row.name});
  return keys;
}

std::string valueText(const Assignment& assignment) {
  return assignment.is_text ? std::get<std::string>(assignment.value) : printValue(assignment.value);
}

}  // namespace

RenamedAssignments replaceOldNames(std::vector<Assignment> assignments, const std::vector<StageRows>& tables) {
  const std::map<std::string, PresentKey> keys = presentKeys(tables);
  RenamedAssignments renamed;
  std::map<std::string, Assignment> earlier;  // by present name: the last one under an old name, as it was given
  for (Assignment& assignment : assignments) {
    const std::string old_name = fullName(assignment.stage, assignment.name);
    const auto key = keys.find(old_name);
    if (key == keys.end()) continue;
    const std::string present = fullName(key->second.stage, key->second.name);
    renamed.warnings.push_back(assignment.where + ": " + old_name + " is now called " + present);
    const auto [other, is_first] = earlier.emplace(present, assignment);
    if (!is_first) {
      const std::string other_name = fullName(other->second.stage, other->second.name);
      if (other_name != old_name && valueText(other->second) != valueText(assignment))
        renamed.warnings.push_back(assignment.where + ": " + old_name + " = " + valueText(assignment) + " and " +
                                   other_name + " = " + valueText(other->second) + " (" + other->second.where +
                                   ") are one parameter, " + present + "; the last one counts");
      other->second = assignment;
    }
    assignment.stage = key->second.stage;
    assignment.name = key->second.name;
  }
  renamed.assignments = std::move(assignments);
  return renamed;
}

bool isCalled(const RowInfo& row, const std::string& name) {
  const auto matches = [&name](const std::string& old_name) {
    const std::size_t dot = old_name.find('.');
    return old_name.substr(dot == std::string::npos ? 0 : dot + 1) == name;
  };
  return row.name == name || std::any_of(row.old_names.begin(), row.old_names.end(), matches);
}

}  // namespace urban_nav_core
