// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/shared_settings.hpp"

namespace urban_nav_core {
namespace {

std::string described(const Setting& setting) {
  return fullName(setting.stage, setting.name) + " = " + printValue(setting.value) + " (" + setting.origin + ")";
}

}  // namespace

std::vector<std::string> differingValues(const std::vector<const std::vector<Setting>*>& settings,
                                         const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  for (const std::string& name : names) {
    const Setting* first = nullptr;
    for (const std::vector<Setting>* stage : settings)
      for (const Setting& setting : *stage) {
        if (setting.name != name) continue;
        if (first == nullptr) first = &setting;
        else if (printValue(first->value) != printValue(setting.value))
          sentences.push_back(described(*first) + " and " + described(setting) +
                              " are the same quantity and should be equal");
      }
  }
  return sentences;
}

}  // namespace urban_nav_core
