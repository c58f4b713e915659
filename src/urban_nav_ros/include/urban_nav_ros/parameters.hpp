// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_ros {

/// Returns all parameters in the namespace of the handle, usually a nodelet's private one, for
/// urban_nav_core::serverParameters. Throws UserError naming the parameter that is neither bool, number nor text.
std::map<std::string, urban_nav_core::ParameterValue> serverValues(const ros::NodeHandle& nh);

namespace detail {

template <typename Parameters>
bool hasRow(const urban_nav_core::Table<Parameters>& table, const std::string& name) {
  return std::any_of(table.rows().begin(), table.rows().end(),
                     [&](const auto& row) { return urban_nav_core::isCalled(row, name); });
}

template <typename Parameters>
Parameters loadAssignments(const urban_nav_core::Table<Parameters>& table,
                           std::vector<urban_nav_core::Assignment> assignments) {
  // Default files set all present names; old names were set by the user and must be applied after them.
  std::stable_partition(assignments.begin(), assignments.end(), [&table](const auto& assignment) {
    return std::any_of(table.rows().begin(), table.rows().end(),
                       [&](const auto& row) { return row.name == assignment.name; });
  });
  auto made = load(table, assignments);
  for (const std::string& warning : made.warnings) ROS_WARN("%s", warning.c_str());
  return made.parameters;
}

}  // namespace detail

/// Returns the parameters of `table` from the parameter server in the namespace `where`. Logs a warning for old names,
/// which override present ones. Throws UserError naming a parameter that is not in the table or whose value is invalid.
template <typename Parameters>
Parameters toParameters(const urban_nav_core::Table<Parameters>& table,
                        const std::map<std::string, urban_nav_core::ParameterValue>& values, const std::string& where) {
  return detail::loadAssignments(table, urban_nav_core::serverParameters(table.stage(), values, where));
}

/// Returns the parameters of a stage from its nodelet's private namespace. Warns and throws like toParameters().
template <typename Stage>
Stage readParameters(const ros::NodeHandle& private_nh, const urban_nav_core::Table<Stage>& stage) {
  return toParameters(stage, serverValues(private_nh), private_nh.getNamespace());
}

/// Returns the parameters of a nodelet and of its stage, which share the nodelet's private namespace. Warns and throws
/// like toParameters().
template <typename Own, typename Stage>
std::pair<Own, Stage> readParameters(const ros::NodeHandle& private_nh, const urban_nav_core::Table<Own>& own,
                                     const urban_nav_core::Table<Stage>& stage) {
  std::map<std::string, urban_nav_core::ParameterValue> of_own, of_stage;
  for (const auto& [name, value] : serverValues(private_nh)) {
    const bool is_own = std::any_of(own.rows().begin(), own.rows().end(),
                                    [&, &key = name](const auto& row) { return urban_nav_core::isCalled(row, key); });
    (is_own ? of_own : of_stage)[name] = value;
  }
  const std::string where = private_nh.getNamespace();
  return {toParameters(own, of_own, where), toParameters(stage, of_stage, where)};
}

/// Returns the parameters of readParameters() and those of a table shared by several stages, which are read from the
/// namespace of their stage beside the nodelet and from the private namespace; the latter takes precedence. Warns and
/// throws like toParameters().
template <typename Own, typename Stage, typename Shared>
std::tuple<Own, Stage, Shared> readParameters(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                                              const urban_nav_core::Table<Own>& own,
                                              const urban_nav_core::Table<Stage>& stage,
                                              const urban_nav_core::Table<Shared>& shared) {
  const std::string where = private_nh.getNamespace();
  std::map<std::string, urban_nav_core::ParameterValue> of_own, of_stage, of_shared;
  for (const auto& [name, value] : serverValues(private_nh)) {
    if (detail::hasRow(own, name)) of_own[name] = value;
    else if (detail::hasRow(stage, name)) of_stage[name] = value;
    else (detail::hasRow(shared, name) ? of_shared : of_stage)[name] = value;
  }
  const ros::NodeHandle shared_nh(nh, shared.stage());
  auto assignments =
      urban_nav_core::serverParameters(shared.stage(), serverValues(shared_nh), shared_nh.getNamespace());
  for (auto& each : urban_nav_core::serverParameters(shared.stage(), of_shared, where))
    assignments.push_back(std::move(each));
  return {toParameters(own, of_own, where), toParameters(stage, of_stage, where),
          detail::loadAssignments(shared, std::move(assignments))};
}

}  // namespace urban_nav_ros
