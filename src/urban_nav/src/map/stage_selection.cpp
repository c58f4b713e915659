// SPDX-License-Identifier: BSD-3-Clause
#include "map/stage_selection.hpp"

#include <algorithm>

#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

void checkWords(const std::vector<std::string>& words, const AllStages& stages) {
  const std::vector<std::string> names = stageNames(stages);
  for (const std::string& word : words) {
    if (!contains(names, word)) throw UserError("--stages", "no stage \"" + word + "\"", urban_nav_core::joined(names));
  }
}

}  // namespace

StageList selectStages(const std::vector<std::unique_ptr<Stage>>& stages, const MapOptions& options, Console& console) {
  checkWords(options.stages, stages);
  StageList selected;
  std::vector<std::string> names, left_out, notes;
  for (const std::unique_ptr<Stage>& stage : stages) {
    const Stage::Description description = stage->describe();
    const Stage::Selection selection = stage->select(options);
    if (selection.enabled) {
      selected.push_back(stage.get());
      names.push_back(description.name);
      notes.insert(notes.end(), selection.notes.begin(), selection.notes.end());
    } else if (description.listed && isRequested(options, description.name)) {
      left_out.push_back(description.name + " (" + selection.reason + ")");
    }
  }
  console.info("stages: " + urban_nav_core::joined(names) +
               (left_out.empty() ? "" : "; left out: " + urban_nav_core::joined(left_out)));
  for (const std::string& note : notes) console.info(note);
  const bool uses_closures =
      std::any_of(selected.begin(), selected.end(), [](const Stage* stage) { return stage->describe().uses_closures; });
  if (!options.closures.empty() && !uses_closures)
    console.warn("--closures is not used: none of the stages of this run reads closures");
  return selected;
}

}  // namespace urban_nav
