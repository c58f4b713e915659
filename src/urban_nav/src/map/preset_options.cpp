// SPDX-License-Identifier: BSD-3-Clause
#include "map/preset_options.hpp"

#include <algorithm>
#include <map>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/driver_presets.hpp"

namespace urban_nav {

using urban_nav_input::DriverPreset;

namespace {

constexpr const char* kInputStage = "input";
constexpr const char* kDefaultOrigin = "default";

bool isSetByUser(const ParameterSet& parameters, const std::string& name) {
  const std::vector<urban_nav_core::Setting> settings = parameters.settings(kInputStage);
  return std::any_of(settings.begin(), settings.end(), [&](const urban_nav_core::Setting& setting) {
    return setting.name == name && setting.origin != kDefaultOrigin;
  });
}

}  // namespace

Option presetOption() {
  return {"--preset",
          "NAME",
          "topics, units and frames of a driver, for each device once; --topic, --set and the transforms of the "
          "recording take precedence",
          false,
          true,
          urban_nav_input::driverPresetNames()};
}

std::string presetHelp(bool is_whole) {
  std::string text = is_whole ? "Presets (--preset):\n" : "Presets (--preset; their topics: --help-all):\n";
  for (const DriverPreset& preset : urban_nav_input::driverPresets()) {
    text += std::string("  ") + preset.name + ": " + preset.driver + "\n";
    if (!is_whole) continue;
    for (const urban_nav_input::PresetRole& role : preset.roles) {
      text += std::string("    ") + role.role + ":";
      for (const char* name : role.names) text += std::string(" .../") + name;
      text += role.is_required ? "\n" : " (optional)\n";
    }
    for (const auto& [name, value] : preset.units)
      text += "    input." + name + "=" + urban_nav_core::printNumber(value) + "\n";
    if (*preset.base_frame != '\0')
      text += std::string("    base_link in a recording without it: ") + preset.base_frame + "\n";
  }
  return text;
}

void setPresetUnits(const Arguments& arguments, ParameterSet& parameters) {
  std::map<std::string, std::pair<double, std::string>> units;
  for (const std::string& preset : arguments.all("preset"))
    for (const auto& [name, value] : urban_nav_input::findDriverPreset(preset).units) {
      const auto& [known, of_preset] = units.emplace(name, std::pair(value, preset)).first->second;
      if (known != value)
        throw urban_nav_core::UserError("--preset " + preset, "has another input." + name + " than " + of_preset,
                                        "--set input." + name + "=VALUE");
    }
  for (const auto& [name, value] : units)
    if (!isSetByUser(parameters, name))
      parameters.set(std::string(kInputStage) + "." + name + "=" + urban_nav_core::printNumber(value.first));
}

void addPresetTopics(const Arguments& arguments, urban_nav_input::SourceOptions& options) {
  for (const std::string& name : arguments.all("preset")) {
    options.topics.push_back("preset:=" + name);
    for (std::string& text : urban_nav_input::presetTransforms(urban_nav_input::findDriverPreset(name)))
      options.transforms.push_back(std::move(text));
  }
}

}  // namespace urban_nav
