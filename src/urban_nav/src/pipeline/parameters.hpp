// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/json.hpp"
#include "dense_stereo/parameters.hpp"
#include "input/input_parameters.hpp"
#include "loop_metric/parameters.hpp"
#include "pose_graph/parameters.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"

namespace urban_nav {

/// What belongs to the command itself and to no stage: keys without a stage in front.
struct CommandParameters {
  int memory_mb;  // MB
  CommandParameters();
};
const urban_nav_core::Table<CommandParameters>& commandTable();

/// The parameters of all stages, from --config and --set.
struct AllParameters {
  urban_nav_core::Loaded<CommandParameters> command;
  urban_nav_core::Loaded<InputParameters> input;
  urban_nav_core::Loaded<swf_vo::Parameters> swf_vo;
  urban_nav_core::Loaded<pose_graph::Parameters> pose_graph;
  urban_nav_core::Loaded<loop_metric::Parameters> loop_metric;
  urban_nav_core::Loaded<dense_stereo::Parameters> dense_stereo;

  /// Old names that were used, and parameters to which two stages are given different values: for the user.
  std::vector<std::string> warnings;

  /// Of all of them, each with its value and where that came from.
  std::vector<const std::vector<urban_nav_core::Setting>*> settings() const;
};
AllParameters loadParameters(const Arguments& arguments);

/// --config, --set and --threads of a command that runs no stage: refused where they are wrong, so that one file and
/// one set of options serve every command.
void checkCommonOptions(const Arguments& arguments);

/// For --help of such a command: the parameters that belong to no stage.
std::string commonHelp(const Arguments& arguments);

/// For --help: each parameter with its value and where that came from, --config and --set of the same call included.
std::string parametersHelp(const Arguments& arguments);

/// For summary.json: stage, key, value, origin.
Json parametersJson(const AllParameters& parameters);

}  // namespace urban_nav
