// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"
#include "base/parameter_set.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav {

/// Returns the option --preset.
Option presetOption();

/// Returns the table of the presets for --help: their names and drivers; `is_whole`: also their topics and units, for
/// --help-all.
std::string presetHelp(bool is_whole);

/// Sets the parameters of stage input that follow from the units of the presets given on the command line, unless they
/// are set. Throws UserError for an unknown preset, and for two presets with different units.
void setPresetUnits(const Arguments& arguments, ParameterSet& parameters);

/// Adds the topics and transforms of the presets to those that the user gave, which take precedence.
void addPresetTopics(const Arguments& arguments, urban_nav_input::SourceOptions& options);

}  // namespace urban_nav
