// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "base/parameters.hpp"
#include "base/usage.hpp"
#include "scene_labeler/class_map.hpp"
#include "scene_labeler/labelling/superpixels.hpp"
#include "scene_labeler/parameters.hpp"
#include "scene_labeler/training/train.hpp"
#include "topics/labels/label_drive.hpp"
#include "topics/labels/label_sources.hpp"
#include "topics/labels/label_teaching.hpp"
#include "topics/labels/labels.hpp"
#include "topics/labels/labels_actions.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

using scene_labeler::ClassifierKind;
using scene_labeler::ClassMap;
using scene_labeler::FeatureSet;

ClassifierKind classifierFrom(const Arguments& arguments, ClassifierKind preset) {
  const std::string name = arguments.get("classifier", toString(preset));
  for (const ClassifierKind kind : {ClassifierKind::Svm, ClassifierKind::Forest})
    if (name == toString(kind)) return kind;
  return ClassifierKind::Boosted;
}

/// Computes the features of scenes one after another and keeps the samples of each for training.
void readTrainingScenes(const std::vector<SceneFiles>& scenes, const ClassMap& map, FeatureSet features, int superpixel,
                        Console& console, std::vector<scene_labeler::TrainingFold>& folds) {
  if (scenes.empty()) return;
  const bool is_alone = scenes.size() == 1 && folds.empty();
  const std::vector<std::string> names = uniqueSceneNames(scenes);
  Progress progress(console, "scenes", "scenes", static_cast<std::int64_t>(scenes.size()));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scene_labeler::TrainingScene training;
    training.fold = names[i];
    training.labels = map.toClasses(readSceneLabels(scenes[i], !map.isOwnNumbers()), scenes[i].points);
    const scene_labeler::Scene scene = readScene(scenes[i]).scene;
    for (std::size_t point = 0; point < scene.points.size(); ++point)
      if (!scene.points[point].allFinite()) training.labels[point] = scene_labeler::SceneClass::None;
    training.features = scene_labeler::measureFeatures(scene, features);
    training.patches = scene_labeler::makePatches(scene, scene_labeler::makeSuperpixels(scene.view.image, superpixel));
    if (is_alone) scene_labeler::addHalves(training, scene, {}, folds);
    else scene_labeler::addScene(training, {}, folds);
    progress.update(static_cast<std::int64_t>(i + 1));
  }
  progress.finish(static_cast<std::int64_t>(scenes.size()));
}

std::vector<scene_labeler::TrainingFold> readTrainingSources(const LabelSources& sources, const ClassMap& map,
                                                             FeatureSet features, int superpixel, Console& console,
                                                             std::vector<scene_labeler::TrainingFold> folds) {
  const bool is_alone = folds.empty() && sources.bags.size() == 1 && sources.scenes.empty();
  for (std::size_t i = 0; i < sources.bags.size(); ++i)
    addDriveFold(sources.bags[i], sources.drives[i], map, features, is_alone, console, folds);
  readTrainingScenes(sources.scenes, map, features, superpixel, console, folds);
  return folds;
}

Json settingJson(const scene_labeler::ValidatedSetting& setting) {
  Json json = Json::object();
  for (const auto& [name, value] : setting.values) json[name] = value;
  json["f1_mean"] = setting.f1_mean;
  return json;
}

Json trainingJson(const scene_labeler::TrainedModel& trained, const std::string& bytes, double seconds) {
  Json json = Json::object();
  json["classifier"] = toString(trained.model.kind);
  json["features"] = toString(trained.model.features);
  json["samples"] = Json::object();
  for (const auto& [scene_class, count] : trained.samples) json["samples"][toString(scene_class)] = count;
  json["sources"] = Json::array();
  for (const std::string& source : trained.model.sources) json["sources"].append(source);
  json["folds"] = trained.folds;
  json["cross_validation"] = Json::array();
  for (const auto& setting : trained.cross_validation) json["cross_validation"].append(settingJson(setting));
  json["chosen"] = Json::object();
  if (!trained.cross_validation.empty()) json["chosen"] = settingJson(trained.cross_validation[trained.chosen]);
  json["sure"] = Json::array();
  for (const auto& row : trained.model.sure.rows())
    json["sure"].append(Json::object({{"probability", toRoundDouble(row.least)},
                                      {"wrong", toRoundDouble(row.wrong)},
                                      {"answered", toRoundDouble(row.answered)}}));
  json["seconds"] = seconds;
  json["digest"] = scene_labeler::modelDigest(bytes);
  return json;
}

/// Describes the threshold of sure labels for the standard precision.
std::string sureSentence(const scene_labeler::LabelModel& model) {
  using urban_nav_core::printNumber;
  if (model.sure.empty()) return "one site: no thresholds of sure labels, which need cross-validation by site";
  const auto& row = model.sure.rowFor(scene_labeler::kStandardPrecision);
  const auto percent = [](float share) {
    return printNumber(std::round(1000.0 * static_cast<double>(share)) / 10.0) + " %";
  };
  return "labels are sure from a probability of " + printNumber(row.least) + ": " +
         percent(row.answered) + " of the returns of held-out sites, " + percent(row.wrong) + " of these wrong";
}

int runLabelsTrain(const OdometryRunner& run_odometry, const Arguments& arguments, Console& console) {
  const Usage usage;
  const ParameterSet parameters = loadParameters(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const LabelTeaching teaching(arguments);
  scene_labeler::TrainingOptions options;
  options.base = teaching.base();
  options.adds_trees = arguments.all("SRC").empty() && !teaching.keepsClassifier();
  options.kind = classifierFrom(arguments, options.base ? options.base->kind : ClassifierKind::Boosted);
  options.features = teaching.features();
  options.seed = static_cast<std::uint64_t>(arguments.integer("seed", 1, 0, 1'000'000'000));
  const ClassMap map = readClassMap(arguments);
  options.samples_per_class = static_cast<std::size_t>(parameters.get(scene_labeler::table()).samples);
  const LabelSources sources = findLabelSources(arguments, parameters, run_odometry);
  options.device = teaching.device(sources);
  const int superpixel = parameters.get(scene_labeler::table()).superpixel;
  auto folds = teaching.folds();
  folds = readTrainingSources(sources, map, options.features, superpixel, console, std::move(folds));
  teaching.addCorrections(map, {run_odometry, &parameters, arguments.all("topic"), ""}, console, folds);
  Progress progress(console, "training", "%", 100);
  scene_labeler::TrainedModel trained = scene_labeler::trainModel(
      std::move(folds), options, [&](double share) { progress.update(static_cast<std::int64_t>(100.0 * share)); });
  progress.finish(100);
  if (teaching.keepsClassifier()) {
    scene_labeler::SureThresholds sure = std::move(trained.model.sure);
    trained.model = *teaching.base();
    trained.model.sure = std::move(sure);
  }
  const std::string bytes = scene_labeler::printModel(trained.model);
  urban_nav_core::writeAtomically(arguments.get("output"), bytes);
  const std::string quality = trained.cross_validation.empty()
                                  ? "with trees for the corrections"
                                  : "mean F1 " +
                                        urban_nav_core::printNumber(trained.cross_validation[trained.chosen].f1_mean) +
                                        " in cross-validation";
  console.info(sureSentence(trained.model));
  console.info(std::string(toString(trained.model.kind)) + " of " + std::to_string(trained.folds) + " folds, " +
               quality + "; model " + scene_labeler::modelDigest(bytes) + ", " + std::to_string(bytes.size()) +
               " bytes");
  if (arguments.has("json"))
    urban_nav_core::writeAtomically(arguments.get("json"), trainingJson(trained, bytes, usage.wallSeconds()).print());
  return 0;
}

Command labelsTrainAction(const OdometryRunner& run_odometry) {
  Command action;
  action.name = "train";
  action.summary = "Trains a classifier of laser returns on labelled scenes.";
  action.options = {
      {"SRC",
       "",
       "bags with BAG_STEM.truth, folders of scenes NAME_points.{csv,ply,las}[.gz] with labels, or such files",
       false,
       true,
       {}},
      {"-o,--output", "MODEL", "model to write", true, false, {}},
      {"--classifier", "NAME", "kind of classifier (default boosted)", false, false, {"svm", "forest", "boosted"}},
      {"--features", "NAME", "features of a return (default all)", false, false, {"paper", "all"}},
      classesOption(),
      {"--seed", "N", "seed of the samples and features (default 1)", false, false, {}},
      {"--add",
       "MODEL",
       "model whose samples are added; SRC may be omitted with --corrections. Alone: MODEL is kept and given the "
       "thresholds of sure labels by cross-validation over its samples",
       false,
       false,
       {}},
      {"--corrections",
       "EDITED",
       "map.ply or scene with edited column label or scalar_label, or bag,side,stamp_ns,beam,class of clicks in bags",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  for (const Option& option : driveCommandOptions()) action.options.push_back(option);
  action.examples = {"urban_nav labels train street1 street2 -o street.labels --classes classes.csv",
                     "urban_nav labels train --add street.labels --corrections edited.ply -o taught.labels"};
  action.more_help = [](const Arguments& arguments) { return stageHelp(arguments, scene_labeler::table().stage()); };
  action.run = [run_odometry](const Arguments& arguments, Console& console) {
    return runLabelsTrain(run_odometry, arguments, console);
  };
  return action;
}

}  // namespace

Command labelsCommand(const OdometryRunner& run_odometry) {
  Command command;
  command.name = "labels";
  command.summary = "Classes of laser returns, with probabilities.";
  command.actions = {labelsTrainAction(run_odometry), labelsApplyAction(run_odometry),
                     labelsEvaluateAction(run_odometry)};
  return command;
}

}  // namespace urban_nav
