// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "urban_nav_input/recording/bag_topics.hpp"

namespace urban_nav_input {

/// Returns the role of a word ("left_info"); nullopt for another word.
std::optional<Role> roleFromWord(const std::string& word);

/// Returns whether messages of a type can serve a role.
bool fits(Role role, const std::string& type);

}  // namespace urban_nav_input
