// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "urban_nav_input/recording/bag_topics.hpp"

namespace urban_nav_input {

/// Returns NAME of a wish `preset:=NAME`; nullopt for another wish.
std::optional<std::string> findPresetWish(const std::string& wish);

/// Chooses the topics of a driver preset for the roles that have none, notes what the recording lacks of its optional
/// roles, and adds the roles to `presets` with the name of the preset. Throws UserError for an unknown preset, and with
/// all missing roles if the recording lacks a required one.
void takePreset(const std::map<std::string, std::string>& available, const std::string& name, BagTopics& topics,
                std::map<Role, std::string>& presets);

}  // namespace urban_nav_input
