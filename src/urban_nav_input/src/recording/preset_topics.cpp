// SPDX-License-Identifier: BSD-3-Clause
#include "recording/preset_topics.hpp"

#include <algorithm>
#include <vector>

#include "recording/role_names.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/driver_presets.hpp"

namespace urban_nav_input {
namespace {

using AvailableTopics = std::map<std::string, std::string>;

constexpr const char* kPresetWord = "preset:=";
constexpr const char* kCloudsWord = "points";

bool isTakenTopic(const BagTopics& topics, const std::string& name) {
  return std::any_of(topics.chosen.begin(), topics.chosen.end(),
                     [&](const auto& chosen) { return chosen.second.name == name; });
}

/// Returns the free topics of a role by the first of its names that fits any, in the order of their names.
std::vector<ChosenTopic> findPresetTopics(const AvailableTopics& available, const PresetRole& wanted, Role role,
                                          const BagTopics& topics) {
  std::vector<ChosenTopic> found;
  for (const char* name : wanted.names) {
    for (const auto& [topic, type] : available)
      if (hasPresetName(topic, name) && fits(role, type) && !isTakenTopic(topics, topic))
        found.push_back({topic, type});
    if (!found.empty()) return found;
  }
  return found;
}

bool isClouds(const PresetRole& wanted) { return std::string(wanted.role) == kCloudsWord; }

/// Returns the roles of a row.
std::vector<Role> listRoles(const PresetRole& wanted) {
  if (!isClouds(wanted)) return {roleFromWord(wanted.role).value()};
  std::vector<Role> roles;
  for (std::size_t lidar = 0; lidar < kPointsTopics; ++lidar) roles.push_back(pointsRole(lidar));
  return roles;
}

/// Returns "left (.../infra1/image_rect_raw)".
std::string describeRole(const PresetRole& wanted) {
  std::string names;
  for (const char* name : wanted.names) names += (names.empty() ? ".../" : " or .../") + std::string(name);
  return std::string(wanted.role) + " (" + names + ")";
}

std::string presetUnits(const DriverPreset& preset) {
  std::string text;
  for (const auto& [name, value] : preset.units)
    text += "; input." + name + " is " + urban_nav_core::printNumber(value) + " unless it is set";
  return text;
}

/// Reports roles of which a recording needs at least one.
void requireAny(const DriverPreset& preset, const std::vector<std::string>& taken, std::vector<std::string>& missing) {
  if (preset.any_of.empty()) return;
  std::string words;
  for (const PresetRole& wanted : preset.roles) {
    const auto isWanted = [&](const char* word) { return std::string(word) == wanted.role; };
    if (std::none_of(preset.any_of.begin(), preset.any_of.end(), isWanted)) continue;
    if (std::find(taken.begin(), taken.end(), wanted.role) != taken.end()) return;
    words += (words.empty() ? "" : " or ") + describeRole(wanted);
  }
  missing.push_back(words);
}

}  // namespace

std::optional<std::string> findPresetWish(const std::string& wish) {
  const std::string word = kPresetWord;
  return wish.compare(0, word.size(), word) == 0 ? std::optional(wish.substr(word.size())) : std::nullopt;
}

void takePreset(const AvailableTopics& available, const std::string& name, BagTopics& topics,
                std::map<Role, std::string>& presets) {
  const DriverPreset& preset = findDriverPreset(name);
  std::vector<std::string> missing, absent, taken;
  for (const PresetRole& wanted : preset.roles) {
    const std::vector<Role> roles = listRoles(wanted);
    const bool is_given = !isClouds(wanted) && topics.find(roles.front());
    const std::vector<ChosenTopic> found =
        is_given ? std::vector<ChosenTopic>() : findPresetTopics(available, wanted, roles.front(), topics);
    if (found.empty() && !is_given) (wanted.is_required ? missing : absent).push_back(describeRole(wanted));
    else taken.emplace_back(wanted.role);
    std::size_t next = 0;
    for (const Role role : roles) {
      if (next == found.size()) break;
      if (topics.find(role)) continue;
      topics.chosen[role] = found[next++];
      presets[role] = name;
    }
  }
  requireAny(preset, taken, missing);
  if (!missing.empty())
    throw urban_nav_core::UserError("--preset " + name,
                                    "the recording has no topic of a suitable type for " +
                                        urban_nav_core::joined(missing),
                                    std::string("the topics of ") + preset.driver +
                                        "; --topic ROLE:=NAME gives others");
  topics.notes.push_back("preset " + name + ": " + preset.driver + presetUnits(preset));
  for (const std::string& role : absent) topics.notes.push_back("preset " + name + ": no topic for " + role);
}

}  // namespace urban_nav_input
