// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_ros {

/// All parameters in the name space of the handle, a nodelet's private one as a rule, for
/// urban_nav_core::serverParameters. Throws UserError for one that is neither bool, number nor text, naming it.
std::map<std::string, urban_nav_core::ParameterValue> serverValues(const ros::NodeHandle& nh);

/// A nodelet's own parameters and those of its stage, which share the nodelet's private name space. Throws UserError, naming the parameter, for one that
/// neither table has and for a value that is not allowed.
template <typename Own, typename Stage>
std::pair<Own, Stage> readParameters(const ros::NodeHandle& private_nh, const urban_nav_core::Table<Own>& own,
                                     const urban_nav_core::Table<Stage>& stage) {
  const std::string where = private_nh.getNamespace();
  std::map<std::string, urban_nav_core::ParameterValue> of_own, of_stage;
  for (const auto& [name, value] : serverValues(private_nh)) {
    const bool is_own = std::any_of(own.rows().begin(), own.rows().end(),
                                    [&, &key = name](const auto& row) { return row.name == key; });
    (is_own ? of_own : of_stage)[name] = value;
  }
  return {load(own, urban_nav_core::serverParameters(own.stage(), of_own, where)).parameters,
          load(stage, urban_nav_core::serverParameters(stage.stage(), of_stage, where)).parameters};
}

}  // namespace urban_nav_ros
