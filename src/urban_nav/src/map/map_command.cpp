// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_command.hpp"

#include "base/parameters.hpp"
#include "map/map_pipeline.hpp"
#include "map/preset_options.hpp"
#include "map/stage_list.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav {

namespace {

std::vector<std::string> topicsReadByStages(const AllStages& stages, const ParameterSet& parameters) {
  std::vector<std::string> topics;
  for (const std::unique_ptr<Stage>& stage : stages)
    for (const std::string& topic : stage->topicsRead(parameters)) topics.push_back(topic);
  return topics;
}

std::string mcapPath(const Arguments& arguments) {
  const std::string path = arguments.get("mcap");
  if (!arguments.has("mcap")) return path;
  checkResultPath(path);
  if (arguments.has("localise"))
    throw urban_nav_core::UserError("--mcap", "--localise writes no poses to the store", "one of the two options");
  return path;
}

}  // namespace

MapOptions readMapOptions(const Arguments& arguments, const AllStages& stages) {
  ParameterSet parameters = loadParameters(arguments);
  setPresetUnits(arguments, parameters);
  urban_nav_input::SourceOptions source;
  source.topics = arguments.all("topic");
  source.calibration = arguments.get("calibration");
  source.transforms = arguments.all("transform");
  addPresetTopics(arguments, source);
  source.rate = arguments.number("rate", 0.0, 0.01, 10000.0);
  source.read_elsewhere = topicsReadByStages(stages, parameters);
  apply(parameters.get(urban_nav_input::inputTable()), source);
  const std::optional<double> so_far =
      arguments.has("so-far") ? std::optional(arguments.number("so-far", 1.0, 0.0, 1.0)) : std::nullopt;
  return {arguments.all("INPUT"),
          arguments.get("out"),
          arguments.list("stages"),
          arguments.get("truth"),
          arguments.get("closures"),
          arguments.get("json"),
          source,
          std::move(parameters),
          static_cast<int>(arguments.integer("threads", 0, 1, 1024)),
          so_far,
          arguments.get("store"),
          arguments.has("overwrite"),
          arguments.get("localise"),
          parseOdometryOption(arguments.get("odometry")),
          arguments.has("calibrate"),
          mcapPath(arguments),
          arguments.has("strict")};
}

namespace {

std::string stagesSentence(const AllStages& stages) {
  std::string names;
  for (const std::string& name : stageNames(stages)) names += (names.empty() ? "" : ", ") + name;
  return "of " + names + " (default: all whose inputs exist)";
}

Option calibrateOption() {
  return {"--calibrate",
          "",
          "estimate delay and mounting of the lasers against the trajectory; adopted if held-out places "
          "the estimate agree better, and reported in every case",
          false,
          false,
          {}};
}

Option mcapOption() {
  return {
      "--mcap",
      "FILE.mcap",
      "the results as MCAP for Foxglove, at the stamps of the recording; maps that did not join go to FILE_2 and so on",
      false,
      false,
      {}};
}

Option odometryOption() {
  return {"--odometry",
          "SOURCE",
          "auto, stereo, laser or both: source of the path (default auto: both if there are images and sweeps "
          "of a 3D LiDAR, else the one there is)",
          false,
          false,
          {}};
}

Option topicOption() {
  return {"--topic",
          "ROLE:=NAME",
          "topic of a bag: left, right, left_info, right_info, imu, wheels, truth, points0, ... (default: guessed and "
          "printed)",
          false,
          true,
          {}};
}

std::vector<Option> mapOptions(const AllStages& stages) {
  return {
      {"INPUT", "", "bags, or folders of KITTI, EuRoC or New College", true, true, {}},
      {"-o,--out", "DIR", "folder to write into (created if missing)", true, false, {}},
      {"--overwrite", "", "replace the map of other inputs in DIR (otherwise an error)", false, false, {}},
      {"--stages", "LIST", stagesSentence(stages), false, true, {}},
      odometryOption(),
      {"--closures",
       "FILE",
       "closures.csv: pairs of stamps at the same place; the stage loops measures their transforms (without this "
       "stage, those in the file are used)",
       false,
       false,
       {}},
      topicOption(),
      presetOption(),
      transformOption(),
      {"--calibration",
       "FILE",
       "if the input has none: KITTI's calib.txt, or LEFT.yaml,RIGHT.yaml (camera_info)",
       false,
       false,
       {}},
      {"--rate", "HZ", "frame rate of an image folder without times.txt (default 10)", false, false, {}},
      {"--store",
       "FILE",
       "continue from the sessions of this store: session.db of DIR holds all of them, relaxed together with the new "
       "ones if there are closures (FILE is only read, unless it is that of DIR)",
       false,
       false,
       {}},
      {"--localise",
       "FILE",
       "localise the inputs in the map of this store or release, which is only read: localisation.csv holds poses and "
       "their status",
       false,
       false,
       {}},
      calibrateOption(),
      {"--strict", "", "exit status 1 if a consistency test fails; all files are written", false, false, {}},
      {"--truth", "FILE", "true trajectory, for the report only (default: that of the input)", false, false, {}},
      mcapOption(),
      {"--so-far",
       "SHARE",
       "share of an unfinished recording that the inputs cover, 0...1: below 1 the report is marked as incomplete and "
       "refreshes itself",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
}

}  // namespace

Command mapCommand(StageFactory make_stages, ResultRecorder record) {
  Command command;
  command.name = "map";
  command.summary = "Turns recordings into a trajectory with covariance, and a report.";
  command.options = mapOptions(make_stages());
  command.examples = {"urban_nav map sequences/06 --out out",
                      "urban_nav map robot.bag --topic left:=/cam0/image_raw --set swf_vo.window=25 --out out"};
  command.more_help = [](const Arguments& arguments) {
    return presetHelp(arguments.has("help-all")) + parametersHelp(arguments);
  };
  command.run = [make_stages = std::move(make_stages), record = std::move(record)](const Arguments& arguments,
                                                                                   Console& console) {
    AllStages stages = make_stages();
    const MapOptions options = readMapOptions(arguments, stages);
    for (const std::string& warning : parameterWarnings(options.parameters)) console.warn(warning);
    const std::vector<std::string> failed = runMap(options, std::move(stages), console, record);
    if (failed.empty()) return 0;
    console.warn("consistency tests failed: " + urban_nav_core::joined(failed) +
                 "; see the section Trust of report.html");
    return options.strict ? 1 : 0;
  };
  return command;
}

}  // namespace urban_nav
