// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameters.hpp"

#include <optional>

#include "base/command_parameters.hpp"
#include "urban_nav_core/camera/camera_noise.hpp"
#include "urban_nav_core/io/memory_limit.hpp"
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav {

using urban_nav_core::Assignment;
using urban_nav_core::Audience;

namespace {

std::vector<Assignment> readAssignments(const Arguments& arguments) {
  std::vector<Assignment> assignments;
  for (const std::string& path : arguments.all("config")) {
    const std::vector<Assignment> file = urban_nav_core::readParameters(path);
    assignments.insert(assignments.end(), file.begin(), file.end());
  }
  for (const std::string& setting : arguments.all("set")) assignments.push_back(urban_nav_core::parseSetting(setting));
  return assignments;
}

/// Returns the help on the parameters of one stage, or of all.
std::string helpOf(const Arguments& arguments, const std::string& key, const std::optional<std::string>& stage) {
  const bool for_experts = arguments.has("help-all");
  const Audience audience = for_experts ? Audience::Experts : Audience::Users;
  const ParameterSet parameters = loadParameters(arguments);
  return std::string(for_experts ? "all parameters" : "parameters; all of them: --help-all") +
         " (--config FILE, --set " + key + "=VALUE):\n" +
         (stage ? parameters.help(*stage, audience) : parameters.help(audience));
}

}  // namespace

ParameterSet loadParameters(const Arguments& arguments) {
  ParameterSet parameters;
  parameters.add(commandTable());
  parameters.add(urban_nav_input::inputTable());
  arguments.addTables(parameters);
  parameters.load(readAssignments(arguments));
  urban_nav_core::setMemoryLimit(static_cast<std::size_t>(parameters.get(commandTable()).memory_mb) << 20U);
  return parameters;
}

std::vector<std::string> parameterWarnings(const ParameterSet& parameters) {
  return parameters.warnings(urban_nav_core::cameraNoiseNames());
}

void checkCommonOptions(const Arguments& arguments) {
  loadParameters(arguments);
  arguments.integer("threads", 0, 1, 1024);
}

std::string commonHelp(const Arguments& arguments) { return helpOf(arguments, "KEY", commandTable().stage()); }

std::string stageHelp(const Arguments& arguments, const std::string& stage) {
  return helpOf(arguments, stage + ".KEY", stage);
}

std::string parametersHelp(const Arguments& arguments) { return helpOf(arguments, "STAGE.KEY", std::nullopt); }

}  // namespace urban_nav
