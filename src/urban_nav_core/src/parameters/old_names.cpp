// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/old_names.hpp"

#include <algorithm>
#include <map>

namespace urban_nav_core {
namespace {

using OldWords = std::map<std::string, std::string>;  // present values by old ones

/// Returns the old name without its values: "queue" or "loop_metric.queue".
std::string nameWithoutWords(const std::string& old_name) { return old_name.substr(0, old_name.find(':')); }

/// Returns the OldWords of an old name, "forget: delete = none, keep = all".
OldWords parseOldWords(const std::string& old_name) {
  OldWords words;
  std::string word, present;
  std::string* part = &word;
  for (std::size_t i = std::min(old_name.find(':'), old_name.size() - 1) + 1; i <= old_name.size(); ++i) {
    const char c = i < old_name.size() ? old_name[i] : ',';
    if (c == '=') {
      part = &present;
    } else if (c == ',') {
      if (!word.empty()) words[word] = present;
      word.clear();
      present.clear();
      part = &word;
    } else if (c != ' ') {
      *part += c;
    }
  }
  return words;
}

/// Returns "loop_metric.queue" for either form of an old name.
std::string fullOldName(const std::string& stage, const std::string& old_name) {
  const std::string name = nameWithoutWords(old_name);
  return name.find('.') == std::string::npos ? fullName(stage, name) : name;
}

struct PresentKey {
  std::string stage, name;
  ParameterType type;
  OldWords words;
};

std::map<std::string, PresentKey> presentKeys(const std::vector<StageRows>& tables) {
  std::map<std::string, PresentKey> keys;
  for (const StageRows& table : tables)
    for (const RowInfo& row : table.rows)
      for (const std::string& old_name : row.old_names)
        keys.emplace(fullOldName(table.stage, old_name),
                     PresentKey{table.stage, row.name, row.type, parseOldWords(old_name)});
  return keys;
}

std::string valueText(const Assignment& assignment) {
  return assignment.is_text ? std::get<std::string>(assignment.value) : printValue(assignment.value);
}

/// Replaces a renamed value; returns " = none" if it did. Words that became booleans are converted.
std::string replaceOldWord(const PresentKey& key, Assignment& assignment) {
  const std::string* word = std::get_if<std::string>(&assignment.value.base());
  const auto present = word ? key.words.find(*word) : key.words.end();
  if (present == key.words.end()) return "";
  const bool is_switch = key.type == ParameterType::Bool && !assignment.is_text;
  assignment.value = is_switch ? ParameterValue(present->second == "true") : ParameterValue(present->second);
  return " = " + present->second;
}

}  // namespace

RenamedAssignments replaceOldNames(std::vector<Assignment> assignments, const std::vector<StageRows>& tables) {
  const std::map<std::string, PresentKey> keys = presentKeys(tables);
  RenamedAssignments renamed;
  std::map<std::string, Assignment> earlier;  // by present name: last assignment under an old name, as given
  for (Assignment& assignment : assignments) {
    const std::string old_name = fullName(assignment.stage, assignment.name);
    const auto key = keys.find(old_name);
    if (key == keys.end()) continue;
    const std::string present = fullName(key->second.stage, key->second.name);
    const std::string old_word = key->second.words.empty() ? "" : " = " + valueText(assignment);
    const std::string word = replaceOldWord(key->second, assignment);
    renamed.warnings.push_back(assignment.where + ": " + old_name + (word.empty() ? "" : old_word) + " is now called " +
                               present + word);
    const auto [other, is_first] = earlier.emplace(present, assignment);
    if (!is_first) {
      const std::string other_name = fullName(other->second.stage, other->second.name);
      if (other_name != old_name && valueText(other->second) != valueText(assignment))
        renamed.warnings.push_back(assignment.where + ": " + old_name + " = " + valueText(assignment) + " and " +
                                   other_name + " = " + valueText(other->second) + " (" + other->second.where +
                                   ") are one parameter, " + present + "; the last one is used");
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
    const std::string without_words = nameWithoutWords(old_name);
    const std::size_t dot = without_words.find('.');
    return without_words.substr(dot == std::string::npos ? 0 : dot + 1) == name;
  };
  return row.name == name || std::any_of(row.old_names.begin(), row.old_names.end(), matches);
}

}  // namespace urban_nav_core
