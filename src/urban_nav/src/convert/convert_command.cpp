// SPDX-License-Identifier: BSD-3-Clause
#include "convert/convert.hpp"

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "convert/convert_command.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

void checkKind(const std::string& kind, const std::string& source) {
  const urban_nav_input::InputKind found = urban_nav_input::inputKind(source);
  const bool right = (kind == "kitti" && found == urban_nav_input::InputKind::KittiFolder) ||
                     (kind == "euroc" && found == urban_nav_input::InputKind::EurocFolder);
  if (!right)
    throw urban_nav_core::UserError(source, "is no folder of " + kind,
                                    kind == "kitti" ? "image_0/, image_1/, calib.txt" : "mav0/ with cam0 and cam1");
}

int runConvert(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::string kind = arguments.get("FORMAT"), source = arguments.get("SRC"), bag = arguments.get("output");
  Converted converted;
  if (kind == "new-college") {
    converted = convertNewCollege(source, bag, console);
  } else {
    checkKind(kind, source);
    urban_nav_input::SourceOptions options;
    options.calibration = arguments.get("calibration");
    options.rate = arguments.number("rate", 0.0, 0.01, 10000.0);
    converted = convertStereoFolder(source, bag, options, console, arguments.integer("threads", 0, 1, 1024) != 1);
  }
  for (const std::string& note : converted.notes) console.info("  " + note);
  Json json = Json::object();
  json["bag"] = bag;
  Json& counts = json["messages"] = Json::object();
  for (const auto& [topic, count] : converted.counts) {
    console.info("  " + topic + ": " + std::to_string(count));
    counts[topic] = count;
  }
  Json& notes = json["notes"] = Json::array();
  for (const std::string& note : converted.notes) notes.append(note);
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  console.print(bag + "\n");
  return 0;
}

}  // namespace

Command convertCommand() {
  Command command;
  command.name = "convert";
  command.summary = "Turns other people's folders into a bag.";
  command.options = {{"FORMAT", "", "of the folder", true, false, {"kitti", "euroc", "new-college"}},
                     {"SRC", "", "folder (new-college: or the .alog file)", true, false, {}},
                     {"-o,--output", "BAG", "bag to write; it appears when it is complete", true, false, {}},
                     {"--calibration",
                      "FILE",
                      "where a KITTI folder has none: a calib.txt, or LEFT.yaml,RIGHT.yaml (camera_info)",
                      false,
                      false,
                      {}},
                     {"--rate", "HZ", "of a KITTI folder without times.txt (default 10)", false, false, {}},
                     jsonOption(),
                     configOption(),
                     setOption(),
                     threadsOption()};
  command.examples = {"urban_nav convert kitti sequences/06 -o kitti06.bag",
                      "urban_nav convert new-college MOOSLog_3_11_2008_____13_43_32 -o college.bag"};
  command.more_help = commonHelp;
  command.run = runConvert;
  return command;
}

}  // namespace urban_nav
