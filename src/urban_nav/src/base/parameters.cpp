// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameters.hpp"

#include "base/command_parameters.hpp"
#include "urban_nav_core/camera/camera_noise.hpp"
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav {

using urban_nav_core::Assignment;

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

}  // namespace

ParameterSet loadParameters(const Arguments& arguments) {
  ParameterSet parameters;
  parameters.add(commandTable());
  parameters.add(urban_nav_input::inputTable());
  arguments.addTables(parameters);
  parameters.load(readAssignments(arguments));
  return parameters;
}

std::vector<std::string> parameterWarnings(const ParameterSet& parameters) {
  return parameters.warnings(urban_nav_core::cameraNoiseNames());
}

void checkCommonOptions(const Arguments& arguments) {
  loadParameters(arguments);
  arguments.integer("threads", 0, 1, 1024);
}

std::string commonHelp(const Arguments& arguments) {
  return "parameters (--config FILE, --set KEY=VALUE):\n" + loadParameters(arguments).help(commandTable().stage());
}

std::string stageHelp(const Arguments& arguments, const std::string& stage) {
  return "parameters (--config FILE, --set " + stage + ".KEY=VALUE):\n" + loadParameters(arguments).help(stage);
}

std::string parametersHelp(const Arguments& arguments) {
  return "parameters (--config FILE, --set STAGE.KEY=VALUE):\n" + loadParameters(arguments).help();
}

}  // namespace urban_nav
