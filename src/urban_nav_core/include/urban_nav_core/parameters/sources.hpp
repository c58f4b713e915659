// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/parameters/assignment.hpp"
#include "urban_nav_core/parameters/old_names.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// A YAML file: a map of stages, each a map of rows; rows without a stage stand at the top level. Throws UserError with
/// file and line for what is no such map and for a key that stands twice.
std::vector<Assignment> readParameters(const std::string& path);
/// The same from text; `name` stands for the path in errors.
std::vector<Assignment> parseParameters(std::string_view text, const std::string& name);

/// "swf_vo.window=25" as given to --set. Throws UserError where there is no key or no "=".
Assignment parseSetting(const std::string& text);

/// What a nodelet found below its private name space: `values` by row name, e.g. from ros::NodeHandle::getParam.
std::vector<Assignment> serverParameters(const std::string& stage, const std::map<std::string, ParameterValue>& values,
                                         const std::string& name_space);

/// A value as it is in force, and where it came from: "default" or Assignment::where.
struct Setting {
  std::string stage, name;
  ParameterValue value;
  std::string origin;
};

/// The settings of one stage: defaults, overridden by the assignments to this stage in their order (so pass YAML first,
/// then the parameter server, then --set). Throws UserError for an unknown key, naming the nearest known one, and for a
/// value of the wrong type or out of range. Assignments to other stages are skipped: refuseUnknownStages sees to them.
std::vector<Setting> resolve(const std::string& stage, const std::vector<RowInfo>& rows,
                             const std::vector<Assignment>& assignments);

/// Throws UserError for the first assignment to a stage that is not in the list.
void refuseUnknownStages(const std::vector<Assignment>& assignments, const std::vector<std::string>& stages);

/// Parameters filled from all sources.
template <typename Parameters>
struct Loaded {
  Parameters parameters;
  std::vector<Setting> settings;      ///< in the order of the table
  std::vector<std::string> warnings;  ///< of old names, for the user
};

template <typename Parameters>
Loaded<Parameters> load(const Table<Parameters>& table, const std::vector<Assignment>& assignments) {
  const RenamedAssignments renamed = replaceOldNames(assignments, {{table.stage(), table.rows()}});
  Loaded<Parameters> loaded{Parameters(), resolve(table.stage(), table.rows(), renamed.assignments), renamed.warnings};
  for (const Setting& setting : loaded.settings) table.set(loaded.parameters, setting.name, setting.value);
  return loaded;
}

}  // namespace urban_nav_core
