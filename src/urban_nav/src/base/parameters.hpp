// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/command.hpp"
#include "base/parameter_set.hpp"

namespace urban_nav {

/// Returns the parameters of the command and of all stages, from --config and --set, and sets the memory limit of the
/// process to `memory_mb`. Throws UserError for unknown or bad ones.
ParameterSet loadParameters(const Arguments& arguments);

/// Returns warnings for the user: old names that were used, and camera properties that differ between two stages.
std::vector<std::string> parameterWarnings(const ParameterSet& parameters);

/// Checks --config, --set and --threads of a command that runs no stage, so that all commands accept the same options.
/// Throws UserError.
void checkCommonOptions(const Arguments& arguments);

/// Return the parameters for --help, or all for --help-all, with their values including --config and --set of the same
/// call: those without a stage, those of one stage, and those of all stages.
std::string commonHelp(const Arguments& arguments);
std::string stageHelp(const Arguments& arguments, const std::string& stage);
std::string parametersHelp(const Arguments& arguments);

}  // namespace urban_nav
