// SPDX-License-Identifier: BSD-3-Clause
#include "commands/commands.hpp"
#include "pipeline/map_pipeline.hpp"

namespace urban_nav {

namespace {

MapRequest requestOf(const Arguments& arguments) {
  AllParameters parameters = loadParameters(arguments);
  const InputParameters& input = parameters.input.parameters;
  const SourceOptions source{arguments.all("topic"),
                             arguments.get("calibration"),
                             arguments.number("rate", 0.0, 0.01, 10000.0),
                             input.motion_input,
                             input.wheel_noise,
                             input.gyro_noise};
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
          arguments.get("localise")};
}

}  // namespace

Command mapCommand() {
  Command command;
  command.name = "map";
  command.summary = "Turns recordings into a trajectory with covariance, and a report.";
  command.options = {
      {"INPUT", "", "bags, or folders of KITTI, EuRoC or New College", true, true, {}},
      {"-o,--out", "DIR", "folder to write into (made if need be)", true, false, {}},
      {"--stages", "LIST", "of vo, loops, graph (default: all whose inputs exist)", false, true, {}},
      {"--closures",
       "FILE",
       "closures.csv: moments that are one place; the stage loops finds their transforms (without it, those in the file count)",
       false,
       false,
       {}},
      {"--topic",
       "ROLE:=NAME",
       "topic of a bag: left, right, left_info, right_info, imu, wheels, truth (default: guessed and said)",
       false,
       true,
       {}},
      {"--calibration",
       "FILE",
       "where the input has none: KITTI's calib.txt, or LEFT.yaml,RIGHT.yaml (camera_info)",
       false,
       false,
       {}},
      {"--rate", "HZ", "of an image folder without times.txt (default 10)", false, false, {}},
      {"--store",
       "FILE",
       "go on from the sessions of this store: relaxed together with the new ones where there are closures, session.db of DIR holds all (FILE is only read, but for the one of DIR itself)",
       false,
       false,
       {}},
      {"--localise",
       "FILE",
       "find the inputs in the map of this store, which stays as it is: localisation.csv says where, and whether that is KNOWN",
       false,
       false,
       {}},
      {"--truth", "FILE", "trajectory for the report alone (default: what the input has)", false, false, {}},
      {"--so-far",
       "SHARE",
       "of a recording that goes on, 0...1, these inputs are this share: until 1 the report says so and refreshes itself",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav map sequences/06 --out out",
                      "urban_nav map robot.bag --topic left:=/cam0/image_raw --set swf_vo.window=25 --out out"};
  command.more_help = parametersHelp;
  command.run = [](const Arguments& arguments, Console& console) {
    const MapRequest request = requestOf(arguments);
    for (const std::string& warning : request.parameters.warnings) console.warn(warning);
    runMap(request, console);
    return 0;
  };
  return command;
}

}  // namespace urban_nav
