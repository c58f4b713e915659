// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "scene_labeler/parameters.hpp"
#include "topics/labels/drive_bag.hpp"
#include "topics/labels/label_model_file.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "view/page_serving.hpp"
#include "view/teach/teach_routes.hpp"
#include "view/view.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kMostTaughtPoints = 5'000'000;  // about 2 GB with features and answers

/// Returns the one scene of INPUT.
SceneFiles findTaughtScene(const std::string& input) {
  if (isBag(input))
    throw UserError(input, "is a recording", "a cloud; `map` makes map.ply of a recording, which can be taught");
  const std::vector<SceneFiles> scenes = findScenes({input});
  if (scenes.size() == 1) return scenes.front();
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(scenes.size(), 4); ++i)
    names += (i > 0 ? ", " : "") + std::filesystem::path(scenes[i].points).filename().string();
  throw UserError(input, "has " + std::to_string(scenes.size()) + " scenes", "one of them: " + names);
}

/// Returns the file of corrections: that of --corrections, else NAME_corrections.ply in the current folder.
std::string correctionsPath(const Arguments& arguments, const SceneFiles& scene) {
  const std::string path = arguments.get("corrections", scene.name + "_corrections.ply");
  if (!urban_nav_core::endsWith(path, ".ply")) throw UserError("--corrections", path, "a file NAME.ply");
  std::error_code ignored;
  if (std::filesystem::equivalent(path, scene.points, ignored))
    throw UserError("--corrections", path + " is the input", "another file, which is written");
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (!std::filesystem::is_directory(folder))
    throw UserError("--corrections", path + ": folder " + folder.string() + " does not exist", "a folder that exists");
  return path;
}

int runLabelsTeach(const Arguments& arguments, Console& console) {
  const ParameterSet parameters = loadParameters(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  PageServing serving(arguments);
  serving.open();
  const scene_labeler::Parameters& labeler = parameters.get(scene_labeler::table());
  TeachSource::Setup setup;
  setup.files = findTaughtScene(arguments.get("INPUT"));
  setup.corrections = correctionsPath(arguments, setup.files);
  setup.model_name = arguments.get("model", labeler.model);
  setup.input = readScene(setup.files);
  setup.model =
      chooseModel(setup.input,
                  readLabelModel(setup.model_name, arguments.number("precision", labeler.precision, 0.5, 0.999)).model);
  if (setup.input.scene.points.size() > kMostTaughtPoints)
    throw urban_nav_core::DataError(setup.files.points, std::to_string(setup.input.scene.points.size()) + " points",
                                    "at most " + std::to_string(kMostTaughtPoints) + "; cut a part out of the cloud");
  setup.options.name = sceneName(setup.corrections);
  setup.options.training.superpixel = labeler.superpixel;
  setup.options.training.samples_per_class = static_cast<std::size_t>(labeler.samples);
  setup.read_only = arguments.has("read-only");
  const std::string corrections = setup.corrections, name = setup.files.points;
  PageEvents events;
  TeachSource source(std::move(setup), events);
  const TeachRoutes routes(source, events);
  console.info("Corrections are written to " + corrections);
  serving.run([&](const HttpRequest& request) { return routes.answer(request); }, [] {}, name, console);
  return 0;
}

}  // namespace

Command labelsTeachAction() {
  Command action;
  action.name = "teach";
  action.summary = "Shows the labels of a scene in the browser, and learns from corrections by mouse.";
  action.options = {
      {"INPUT", "", "scene NAME_points.{csv,ply,las}[.gz], map.ply, or a folder with one scene", true, false, {}},
      {"--model", "MODEL", "model of labels train, or default (default: scene_labeler.model)", false, false, {}},
      {"-o,--corrections",
       "FILE",
       "PLY file of the corrections, continued if it exists; input of labels train --corrections "
       "(default: NAME_corrections.ply in the current folder)",
       false,
       false,
       {}},
      {"--precision",
       "P",
       "share of the labels that are not unsure which is right (default: scene_labeler.precision, 0.98)",
       false,
       false,
       {}}};
  for (const Option& option : pageServingOptions("shows answers and corrections, and takes none"))
    action.options.push_back(option);
  for (const Option& option : {configOption(), setOption(), threadsOption()}) action.options.push_back(option);
  action.examples = {"urban_nav labels teach street_points.las -o street_corrections.ply",
                     "urban_nav labels train --add default --corrections street_corrections.ply -o street.labels"};
  action.more_help = [](const Arguments& arguments) { return stageHelp(arguments, scene_labeler::table().stage()); };
  action.run = runLabelsTeach;
  return action;
}

}  // namespace urban_nav
