// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_teaching.hpp"

#include <algorithm>
#include <filesystem>

#include "scene_labeler/parameters.hpp"
#include "scene_labeler/training/train.hpp"
#include "topics/labels/drive_bag.hpp"
#include "topics/labels/label_clicks.hpp"
#include "topics/labels/label_model_file.hpp"
#include "topics/labels/scene_files.hpp"
#include "topics/labels/teach/correction_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::FeatureSet;
using scene_labeler::LabelModel;
using scene_labeler::TrainingFold;
using urban_nav_core::UserError;

namespace {

bool isClickFile(const std::string& path) {
  return urban_nav_core::endsWith(path, ".csv") && urban_nav_core::CsvTable::read(path).has("bag");
}

/// Returns whether training data are of scenes only, and not of the robot's side lasers.
bool isOfOtherDevice(const std::vector<std::string>& sources, const std::string& corrections) {
  if (std::any_of(sources.begin(), sources.end(), [](const std::string& source) { return isBag(source); }))
    return false;
  if (corrections.empty()) return !sources.empty();
  if (isClickFile(corrections)) return false;
  const std::vector<SceneFiles> found = findScenes({corrections});
  return found.size() != 1 || !readScene(found.front()).is_of_side_lasers;
}

urban_nav_core::DataError nothingCorrected(const std::string& path) {
  return {path, "no label differs from the prediction of the model", "corrected labels"};
}

}  // namespace

void requireSamples(const LabelModel& model, const std::string& name) {
  if (model.samples.empty())
    throw UserError(name, "holds no training samples", "a model that labels train wrote with samples (version 3)");
}

std::string correctionsFold(const std::string& name, const std::vector<TrainingFold>& folds) {
  const std::string plain = "corrections of " + name;
  std::string free = plain;
  const auto is_taken = [&] {
    return std::any_of(folds.begin(), folds.end(), [&](const TrainingFold& fold) { return fold.name == free; });
  };
  for (int number = 2; is_taken(); ++number) free = plain + ", " + std::to_string(number);
  return free;
}

SceneCorrections readSceneCorrections(const std::string& path, const scene_labeler::ClassMap& map, Console& console) {
  const std::vector<SceneFiles> found = findScenes({path});
  if (found.size() != 1) throw UserError(path, std::to_string(found.size()) + " scenes", "one edited scene");
  SceneCorrections corrections{found[0].name, found[0], {}, {}};
  corrections.labels = map.toClasses(readSceneLabels(found[0], !map.isOwnNumbers()), path);
  const std::string pictured = picturedScene(path);
  if (!pictured.empty()) {
    if (std::filesystem::is_regular_file(pictured)) corrections.files = findScenes({pictured}).front();
    else
      console.warn(path + ": " + pictured + " with its image is missing, so the corrections are learnt by shape only");
  }
  corrections.input = readScene(corrections.files);
  if (corrections.input.scene.points.size() != corrections.labels.size())
    throw UserError(corrections.files.points, std::to_string(corrections.input.scene.points.size()) + " points",
                    std::to_string(corrections.labels.size()) + ", as in " + path);
  return corrections;
}

bool SceneCorrections::describes(const SceneInput& scene) const {
  const std::vector<Eigen::Vector3f>&own = input.scene.points, &other = scene.scene.points;
  const auto is_same = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a == b || !a.allFinite(); };
  return input.offset == scene.offset && own.size() == other.size() &&
         std::equal(own.begin(), own.end(), other.begin(), is_same);
}

LabelModel trainWithCorrections(const LabelModel& base, std::vector<TrainingFold> folds,
                                const CorrectionTraining& options) {
  scene_labeler::TrainingOptions training;
  training.kind = base.kind;
  training.features = base.features;
  training.samples_per_class = options.samples_per_class;
  training.seed = options.seed;
  training.device = base.device;
  training.base = &base;
  training.adds_trees = true;
  return scene_labeler::trainModel(std::move(folds), training, [](double) {}).model;
}

LabelModel teachByCorrections(const LabelModel& base, const std::string& name, const SceneCorrections& corrections,
                              const CorrectionTraining& options) {
  const LabelModel& own = chooseModel(corrections.input, base);
  requireSamples(own, name);
  std::vector<TrainingFold> folds = scene_labeler::restoreFolds(own);
  const auto count = scene_labeler::addCorrections(own, corrections.input.scene, corrections.labels, options.superpixel,
                                                   correctionsFold(corrections.name, folds), folds);
  if (count.empty()) throw nothingCorrected(corrections.files.points);
  return trainWithCorrections(own, std::move(folds), options);
}

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
  if (base_->of_other_devices && isOfOtherDevice(arguments.all("SRC"), corrections_))
    base_ = LabelModel(*base_->of_other_devices);
  requireSamples(*base_, path);
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
  fold.name = correctionsFold(std::filesystem::path(corrections_).stem().string(), folds);
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
  const SceneCorrections corrections = readSceneCorrections(corrections_, map, console);
  const auto count = scene_labeler::addCorrections(*base_, corrections.input.scene, corrections.labels, superpixel,
                                                   correctionsFold(corrections.name, folds), folds);
  if (count.empty()) throw nothingCorrected(corrections_);
  console.info(corrections_ + ": " + std::to_string(count.corrected) + " of " + std::to_string(count.labelled) +
               " labelled points differ from the prediction of the model");
}

}  // namespace urban_nav
