// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "commands/labels_actions.hpp"
#include "labels/class_map.hpp"
#include "labels/label_run.hpp"
#include "labels/label_score.hpp"
#include "pipeline/parameters.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

std::string labelsHelp(const Arguments& arguments) { return stageHelp(arguments, scene_labeler::table().stage()); }

int superpixelSize(const Arguments& arguments) {
  return loadParameters(arguments).get(scene_labeler::table()).superpixel;
}

void writeLabelImage(const cv::Mat& image, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  urban_nav_core::writeAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

int runLabelsApply(const Arguments& arguments, Console& console) {
  const int superpixel = superpixelSize(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const scene_labeler::LabelModel model = readLabelModel(arguments.get("MODEL"));
  const std::vector<SceneFiles> scenes = findScenes(arguments.all("SRC"));
  for (std::size_t i = 1; i < scenes.size(); ++i)
    if (scenes[i].name == scenes[i - 1].name)
      throw urban_nav_core::UserError(scenes[i].points, "has the name of " + scenes[i - 1].points,
                                      "one scene of each name, since DIR holds NAME_labels.csv");
  const std::filesystem::path folder(arguments.get("output"));
  std::filesystem::create_directories(folder);
  const LabelRun run =
      labelScenes(model, scenes, superpixel, console, [&](std::size_t i, const scene_labeler::SceneLabels& labels) {
        const std::string base = (folder / (scenes[i].name + "_labels")).string();
        urban_nav_core::writeAtomically(base + ".csv", printSceneLabels(labels));
        if (!labels.image.empty()) writeLabelImage(labels.image, base + ".png");
      });
  console.info(std::to_string(run.labelled) + " of " + std::to_string(run.points) + " points in " +
               std::to_string(run.frames) + " scenes are labelled, " + std::to_string(run.unsure) + " of them unsure" +
               (run.has_look ? "" : "; without images: by shape only"));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), run.toJson().print());
  return 0;
}

int runLabelsEvaluate(const Arguments& arguments, Console& console) {
  const int superpixel = superpixelSize(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const scene_labeler::LabelModel model = readLabelModel(arguments.get("MODEL"));
  const ClassMap map = arguments.has("classes") ? ClassMap(arguments.get("classes")) : ClassMap();
  const std::vector<SceneFiles> scenes = findScenes(arguments.all("SRC"));
  std::vector<std::vector<scene_labeler::SceneClass>> truths;
  const auto& known = model.classes;
  bool one_wall = std::find(known.begin(), known.end(), scene_labeler::SceneClass::Wall) != known.end();
  for (const SceneFiles& files : scenes) {
    truths.push_back(map.toClasses(readSceneLabels(files), files.points));
    const auto& truth = truths.back();
    one_wall = one_wall || std::find(truth.begin(), truth.end(), scene_labeler::SceneClass::Wall) != truth.end();
  }
  LabelScore score(one_wall);
  const LabelRun run =
      labelScenes(model, scenes, superpixel, console,
                  [&](std::size_t i, const scene_labeler::SceneLabels& labels) { score.add(labels, truths[i]); });
  if (score.points() == 0)
    throw urban_nav_core::DataError("SRC", "no point has a label to compare with", "labelled scenes");
  console.print(score.print());
  if (arguments.has("json")) {
    Json json = run.toJson();
    score.addTo(json);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

std::vector<Option> modelAndScenes() {
  return {{"MODEL", "", "model of labels train", true, false, {}},
          {"SRC", "", "folders of scenes NAME_points.{csv,ply}[.gz], or such files", true, true, {}}};
}

void addCommonLabelOptions(Command& action) {
  for (const Option& option : {jsonOption(), configOption(), setOption(), threadsOption()})
    action.options.push_back(option);
  action.more_help = labelsHelp;
}

}  // namespace

Command labelsApplyAction() {
  Command action;
  action.name = "apply";
  action.summary = "Labels every laser return of scenes with a class, its probability, and whether that is unsure.";
  action.options = modelAndScenes();
  action.options.push_back({"-o,--output",
                            "DIR",
                            "folder for NAME_labels.csv and, for scenes with an image, NAME_labels.png",
                            true,
                            false,
                            {}});
  addCommonLabelOptions(action);
  action.examples = {"urban_nav labels apply street.labels scenes -o labelled"};
  action.run = runLabelsApply;
  return action;
}

Command labelsEvaluateAction() {
  Command action;
  action.name = "evaluate";
  action.summary = "Compares the labels of a model with those in scenes.";
  action.options = modelAndScenes();
  action.options.push_back(
      {"--classes", "FILE", "id,class for the values of label (default: the classes' own numbers)", false, false, {}});
  addCommonLabelOptions(action);
  action.examples = {"urban_nav labels evaluate street.labels scenes --classes classes.csv"};
  action.run = runLabelsEvaluate;
  return action;
}

}  // namespace urban_nav
