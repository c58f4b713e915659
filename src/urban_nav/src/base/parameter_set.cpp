// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameter_set.hpp"

#include "urban_nav_core/parameters/old_names.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/parameters/shared_settings.hpp"

namespace urban_nav {

using urban_nav_core::Assignment;
using urban_nav_core::Audience;
using urban_nav_core::Setting;

void ParameterSet::load(const std::vector<Assignment>& assignments) {
  std::vector<urban_nav_core::StageRows> tables;
  std::vector<std::string> stages;
  for (const std::unique_ptr<Group>& group : groups_) {
    tables.push_back({group->stage(), group->rows()});
    stages.push_back(group->stage());
  }
  urban_nav_core::RenamedAssignments renamed = urban_nav_core::replaceOldNames(assignments, tables);
  urban_nav_core::refuseUnknownStages(renamed.assignments, stages);
  for (const std::unique_ptr<Group>& group : groups_) group->load(renamed.assignments);
  assignments_ = assignments;
  old_names_ = std::move(renamed.warnings);
}

void ParameterSet::set(const std::string& assignment) {
  std::vector<Assignment> assignments = assignments_;
  assignments.push_back(urban_nav_core::parseSetting(assignment));
  load(assignments);
}

std::vector<Setting> ParameterSet::settings(const std::string& stage) const {
  const Group* group = find(stage);
  return group != nullptr ? group->settings() : std::vector<Setting>();
}

std::vector<Setting> ParameterSet::settings() const {
  std::vector<Setting> all;
  for (const std::unique_ptr<Group>& group : groups_)
    all.insert(all.end(), group->settings().begin(), group->settings().end());
  return all;
}

std::vector<std::string> ParameterSet::warnings(const std::vector<std::string>& shared) const {
  std::vector<std::string> made = old_names_;
  std::vector<const std::vector<Setting>*> by_stage;
  for (const std::unique_ptr<Group>& group : groups_) by_stage.push_back(&group->settings());
  for (std::string& sentence : urban_nav_core::differingValues(by_stage, shared)) made.push_back(std::move(sentence));
  return made;
}

std::string ParameterSet::help(Audience audience) const {
  std::string text;
  for (const std::unique_ptr<Group>& group : groups_) text += help(group->stage(), audience);
  return text;
}

std::string ParameterSet::help(const std::string& stage, Audience audience) const {
  const Group* group = find(stage);
  if (group == nullptr) return "";
  return audience == Audience::Users ? urban_nav_core::printHelp(stage, group->rows(), group->settings())
                                     : urban_nav_core::printHelpForExperts(stage, group->rows(), group->settings());
}

Json ParameterSet::toJson() const {
  Json json = Json::object();
  for (const Setting& setting : settings()) {
    Json& entry = json[urban_nav_core::fullName(setting.stage, setting.name)] = Json::object();
    entry["value"] = std::visit([](const auto& plain) { return Json(plain); }, setting.value.base());
    entry["origin"] = setting.origin;
  }
  return json;
}

const ParameterSet::Group* ParameterSet::find(const std::string& stage) const {
  for (const std::unique_ptr<Group>& group : groups_)
    if (group->stage() == stage) return group.get();
  return nullptr;
}

}  // namespace urban_nav
