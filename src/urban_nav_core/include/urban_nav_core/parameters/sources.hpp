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

/// Reads a YAML file: a map of stages, each a map of rows; rows without a stage are at the top level. Throws UserError
/// with file and line for any other structure and for a duplicate key.
std::vector<Assignment> readParameters(const std::string& path);
/// Parses the content of such a file; `name` replaces the path in errors.
std::vector<Assignment> parseParameters(std::string_view text, const std::string& name);

/// Parses "swf_vo.window=25", the argument of --set. Throws UserError without a key or "=".
Assignment parseSetting(const std::string& text);

/// Returns the assignments of a nodelet's private namespace: `values` by row name, e.g. from ros::NodeHandle::getParam.
std::vector<Assignment> serverParameters(const std::string& stage, const std::map<std::string, ParameterValue>& values,
                                         const std::string& name_space);

/// Current value of a parameter, and its origin: "default" or Assignment::where.
struct Setting {
  std::string stage, name;
  ParameterValue value;
  std::string origin;
};

/// Returns the settings of one stage: defaults, overridden by the assignments to this stage in their order (pass YAML
/// first, then the parameter server, then --set). Throws UserError for an unknown key, suggesting the most similar one,
/// and for a value of the wrong type or out of range. Assignments to other stages are skipped; see
/// refuseUnknownStages().
std::vector<Setting> resolve(const std::string& stage, const std::vector<RowInfo>& rows,
                             const std::vector<Assignment>& assignments);

/// Throws UserError for the first assignment to a stage that is not in the list.
void refuseUnknownStages(const std::vector<Assignment>& assignments, const std::vector<std::string>& stages);

/// Parameters filled from all sources.
template <typename Parameters>
struct Loaded {
  Parameters parameters;
  std::vector<Setting> settings;      ///< in the order of the table
  std::vector<std::string> warnings;  ///< for the user, about old names
};

template <typename Parameters>
Loaded<Parameters> load(const Table<Parameters>& table, const std::vector<Assignment>& assignments) {
  const RenamedAssignments renamed = replaceOldNames(assignments, {{table.stage(), table.rows()}});
  Loaded<Parameters> loaded{Parameters(), resolve(table.stage(), table.rows(), renamed.assignments), renamed.warnings};
  for (const Setting& setting : loaded.settings) table.set(loaded.parameters, setting.name, setting.value);
  return loaded;
}

}  // namespace urban_nav_core
