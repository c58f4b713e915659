// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_teaching.hpp"

#include <algorithm>
#include <filesystem>

#include "scene_labeler/parameters.hpp"
#include "topics/labels/label_clicks.hpp"
#include "topics/labels/label_model_file.hpp"
#include "topics/labels/scene_files.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::FeatureSet;
using scene_labeler::TrainingFold;
using urban_nav_core::UserError;

namespace {

/// Returns `plain`, with a number appended if a fold has that name.
std::string freeName(const std::string& plain, const std::vector<TrainingFold>& folds) {
  std::string name = plain;
  const auto is_taken = [&] {
    return std::any_of(folds.begin(), folds.end(), [&](const TrainingFold& fold) { return fold.name == name; });
  };
  for (int number = 2; is_taken(); ++number) name = plain + ", " + std::to_string(number);
  return name;
}

bool isClickFile(const std::string& path) {
  return urban_nav_core::endsWith(path, ".csv") && urban_nav_core::CsvTable::read(path).has("bag");
}

}  // namespace

LabelTeaching::LabelTeaching(const Arguments& arguments) {
  if (arguments.has("corrections")) corrections_ = arguments.get("corrections");
  keeps_classifier_ = arguments.all("SRC").empty() && corrections_.empty();
  if (keeps_classifier_ && !arguments.has("add"))
    throw UserError("SRC", "is missing", "labelled scenes, or --add MODEL with --corrections EDITED.ply");
  if (arguments.get("features", "all") == "paper") features_ = FeatureSet::Paper;
  if (!arguments.has("add")) {
    if (!corrections_.empty())
      throw UserError("--corrections", "no model to compare " + corrections_ + " with", "--add MODEL");
    return;
  }
  const std::string path = arguments.get("add");
  base_ = readLabelModel(path).model;
  if (base_->samples.empty())
    throw UserError(path, "holds no training samples", "a model that labels train wrote with samples (version 3)");
  if (arguments.has("features") && features_ != base_->features)
    throw UserError("--features", toString(features_), std::string(toString(base_->features)) + ", those of " + path);
  features_ = base_->features;
}

std::string LabelTeaching::device(const LabelSources& sources) const {
  std::string device;
  if (!sources.bags.empty()) device = sources.scenes.empty() ? scene_labeler::kLms291Device : "several";
  if (!base_ || (sources.bags.empty() && sources.scenes.empty())) return base_ ? base_->device : device;
  return device == base_->device ? device : "several";
}

std::vector<TrainingFold> LabelTeaching::folds() const {
  return base_ ? scene_labeler::restoreFolds(*base_) : std::vector<TrainingFold>();
}

void LabelTeaching::addClicks(const DriveOptions& options, Console& console, std::vector<TrainingFold>& folds) const {
  const LabelClicks clicks(corrections_);
  TrainingFold fold;
  fold.name = freeName("corrections of " + std::filesystem::path(corrections_).stem().string(), folds);
  const std::size_t added = clicks.addTo(*base_, options, console, fold);
  if (added == 0)
    throw urban_nav_core::DataError(corrections_, "no frame shows a clicked return",
                                    "rows of returns that have a label");
  console.info(corrections_ + ": " + std::to_string(added) + " returns in the superpixels of " +
               std::to_string(clicks.size()) + " clicks");
  folds.push_back(std::move(fold));
}

void LabelTeaching::addCorrections(const scene_labeler::ClassMap& map, const DriveOptions& options, Console& console,
                                   std::vector<TrainingFold>& folds) const {
  if (corrections_.empty()) return;
  if (isClickFile(corrections_)) return addClicks(options, console, folds);
  const int superpixel = options.parameters->get(scene_labeler::table()).superpixel;
  const std::vector<SceneFiles> files = findScenes({corrections_});
  if (files.size() != 1) throw UserError(corrections_, std::to_string(files.size()) + " scenes", "one edited scene");
  const std::vector<scene_labeler::SceneClass> labels =
      map.toClasses(readSceneLabels(files[0], !map.isOwnNumbers()), corrections_);
  const std::string name = freeName("corrections of " + files[0].name, folds);
  const auto count = scene_labeler::addCorrections(*base_, readScene(files[0]).scene, labels, superpixel, name, folds);
  if (count.corrected == 0)
    throw urban_nav_core::DataError(corrections_, "no label differs from the prediction of the model",
                                    "corrected labels");
  console.info(corrections_ + ": " + std::to_string(count.corrected) + " of " + std::to_string(count.labelled) +
               " labelled points differ from the prediction of the model");
}

}  // namespace urban_nav
