// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parameters.hpp"

#include "urban_nav_core/camera/camera_noise.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/parameters/shared_settings.hpp"

namespace urban_nav {

using urban_nav_core::Assignment;
using urban_nav_core::ParameterValue;
using urban_nav_core::Setting;
using urban_nav_core::Table;

namespace {

/// Throws UserError for keys of unknown stages.
urban_nav_core::RenamedAssignments assignmentsOf(const Arguments& arguments) {
  std::vector<Assignment> assignments;
  for (const std::string& path : arguments.all("config")) {
    const std::vector<Assignment> file = urban_nav_core::readParameters(path);
    assignments.insert(assignments.end(), file.begin(), file.end());
  }
  for (const std::string& setting : arguments.all("set")) assignments.push_back(urban_nav_core::parseSetting(setting));
  urban_nav_core::RenamedAssignments renamed = urban_nav_core::replaceOldNames(
      std::move(assignments), {{commandTable().stage(), commandTable().rows()},
                               {inputTable().stage(), inputTable().rows()},
                               {swf_vo::table().stage(), swf_vo::table().rows()},
                               {pose_graph::table().stage(), pose_graph::table().rows()},
                               {loop_metric::table().stage(), loop_metric::table().rows()},
                               {dense_stereo::table().stage(), dense_stereo::table().rows()}});
  urban_nav_core::refuseUnknownStages(renamed.assignments,
                                      {"", inputTable().stage(), swf_vo::table().stage(), pose_graph::table().stage(),
                                       loop_metric::table().stage(), dense_stereo::table().stage()});
  return renamed;
}

Json jsonOf(const ParameterValue& value) {
  return std::visit([](const auto& plain) { return Json(plain); }, value.base());
}

}  // namespace

CommandParameters::CommandParameters() { commandTable().setDefaults(*this); }

const Table<CommandParameters>& commandTable() {
  static const Table<CommandParameters> table(
      "", {{"memory_mb",
            &CommandParameters::memory_mb,
            "MB",
            4000,
            200,
            10000000,
            {},
            "Bounds the memory for what is read ahead; the result does not depend on it.",
            ""}});
  return table;
}

std::vector<const std::vector<Setting>*> AllParameters::settings() const {
  return {&command.settings, &input.settings, &swf_vo.settings, &pose_graph.settings, &loop_metric.settings};
}

AllParameters loadParameters(const Arguments& arguments) {
  const urban_nav_core::RenamedAssignments renamed = assignmentsOf(arguments);
  AllParameters all{urban_nav_core::load(commandTable(), renamed.assignments),
                    urban_nav_core::load(inputTable(), renamed.assignments),
                    urban_nav_core::load(swf_vo::table(), renamed.assignments),
                    urban_nav_core::load(pose_graph::table(), renamed.assignments),
                    urban_nav_core::load(loop_metric::table(), renamed.assignments),
                    urban_nav_core::load(dense_stereo::table(), renamed.assignments),
                    renamed.warnings};
  for (std::string& warning : urban_nav_core::differingValues(all.settings(), urban_nav_core::cameraNoiseNames()))
    all.warnings.push_back(std::move(warning));
  return all;
}

void checkCommonOptions(const Arguments& arguments) {
  loadParameters(arguments);
  arguments.integer("threads", 0, 1, 1024);
}

std::string commonHelp(const Arguments& arguments) {
  return "parameters (--config FILE, --set KEY=VALUE):\n" +
         urban_nav_core::printHelp(commandTable().stage(), commandTable().rows(),
                                   loadParameters(arguments).command.settings);
}

std::string parametersHelp(const Arguments& arguments) {
  const AllParameters all = loadParameters(arguments);
  return "parameters (--config FILE, --set STAGE.KEY=VALUE):\n" +
         urban_nav_core::printHelp(commandTable().stage(), commandTable().rows(), all.command.settings) +
         urban_nav_core::printHelp(inputTable().stage(), inputTable().rows(), all.input.settings) +
         urban_nav_core::printHelp(swf_vo::table().stage(), swf_vo::table().rows(), all.swf_vo.settings) +
         urban_nav_core::printHelp(loop_metric::table().stage(), loop_metric::table().rows(),
                                   all.loop_metric.settings) +
         urban_nav_core::printHelp(pose_graph::table().stage(), pose_graph::table().rows(), all.pose_graph.settings);
}

Json parametersJson(const AllParameters& parameters) {
  Json json = Json::object();
  for (const std::vector<Setting>* settings : parameters.settings()) {
    for (const Setting& setting : *settings) {
      Json& entry = json[urban_nav_core::fullName(setting.stage, setting.name)] = Json::object();
      entry["value"] = jsonOf(setting.value);
      entry["origin"] = setting.origin;
    }
  }
  return json;
}

}  // namespace urban_nav
