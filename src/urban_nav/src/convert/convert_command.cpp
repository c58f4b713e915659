// SPDX-License-Identifier: BSD-3-Clause
#include "convert/convert.hpp"

#include <sstream>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "convert/convert_command.hpp"
#include "convert/recording.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

void checkKind(const std::string& kind, const std::string& source) {
  const urban_nav_input::InputKind found = urban_nav_input::inputKind(source);
  const bool right = (kind == "kitti" && found == urban_nav_input::InputKind::KittiFolder) ||
                     (kind == "euroc" && found == urban_nav_input::InputKind::EurocFolder);
  if (!right)
    throw urban_nav_core::UserError(source, "is not a folder of " + kind,
                                    kind == "kitti" ? "image_0/, image_1/, calib.txt" : "mav0/ with cam0 and cam1");
}

Converted convertFolder(const std::string& kind, const std::string& source, const Arguments& arguments,
                        Console& console) {
  for (const char* option : {"topics", "from", "to", "split"})
    if (arguments.has(option))
      throw urban_nav_core::UserError(std::string("--") + option, "does not apply to folders", "recordings only");
  const std::string bag = arguments.get("output");
  if (kind == "new-college") return convertNewCollege(source, bag, console);
  checkKind(kind, source);
  urban_nav_input::SourceOptions options;
  options.calibration = arguments.get("calibration");
  options.rate = arguments.number("rate", 0.0, 0.01, 10000.0);
  return convertStereoFolder(source, bag, options, console, arguments.integer("threads", 0, 1, 1024) != 1);
}

Converted convertInput(const std::string& input, const Arguments& arguments, Console& console) {
  for (const char* option : {"calibration", "rate"})
    if (arguments.has(option))
      throw urban_nav_core::UserError(std::string("--") + option, "does not apply to recordings", "folders only");
  if (urban_nav_input::inputKind(input) != urban_nav_input::InputKind::Bag)
    throw urban_nav_core::UserError(input, "is a folder of images",
                                    "convert kitti, euroc or new-college " + input + " -o FILE");
  RecordingPart part;
  std::istringstream names(arguments.get("topics"));
  for (std::string name; std::getline(names, name, ',');)
    if (!name.empty()) part.topics.push_back(name);
  constexpr double kLongest = 1e9;  // s
  if (arguments.has("from")) part.from = arguments.number("from", 0.0, 0.0, kLongest);
  if (arguments.has("to")) part.to = arguments.number("to", 0.0, 0.0, kLongest);
  if (part.to && *part.to <= part.from.value_or(0.0))
    throw urban_nav_core::UserError("--to " + arguments.get("to"), "is not after --from", "");
  if (arguments.has("split")) part.split = arguments.number("split", 0.0, 0.001, 1e9);
  return convertRecording(input, arguments.get("output"), part, console);
}

int runConvert(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::vector<std::string> words = arguments.all("INPUT");
  const std::string bag = arguments.get("output");
  if (words.size() > 2) throw urban_nav_core::UserError(words[2], "is an extra argument", "INPUT, or FORMAT SRC");
  const bool is_folder = words.size() == 2;
  if (is_folder && words[0] != "kitti" && words[0] != "euroc" && words[0] != "new-college")
    throw urban_nav_core::UserError(words[0], "is not a folder format", "kitti, euroc, new-college");
  const Converted converted =
      is_folder ? convertFolder(words[0], words[1], arguments, console) : convertInput(words[0], arguments, console);
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
  Json& files = json["files"] = Json::array();
  for (const std::string& file : converted.files) files.append(file);
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  for (const std::string& file : converted.files.empty() ? std::vector<std::string>{bag} : converted.files)
    console.print(file + "\n");
  return 0;
}

}  // namespace

Command convertCommand() {
  Command command;
  command.name = "convert";
  command.summary = "Converts a recording or the folder of a public data set into a bag or MCAP.";
  command.options = {
      {"INPUT",
       "",
       "a recording; or kitti, euroc or new-college, and a folder (new-college: or the .alog file)",
       true,
       true,
       {}},
      {"-o,--output", "FILE", "FILE.bag or FILE.mcap to write; it appears when it is complete", true, false, {}},
      {"--topics", "A,B", "topics of the recording (default: all)", false, false, {}},
      {"--from", "S", "begin, s after the first message by receipt (included)", false, false, {}},
      {"--to", "S", "end, s after the first message by receipt (excluded)", false, false, {}},
      {"--split", "MB", "size of the files FILE_0, FILE_1, ...", false, false, {}},
      {"--calibration",
       "FILE",
       "if a KITTI folder has none: a calib.txt, or LEFT.yaml,RIGHT.yaml (camera_info)",
       false,
       false,
       {}},
      {"--rate", "HZ", "rate of a KITTI folder without times.txt (default 10)", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav convert robot.bag -o robot.mcap",
                      "urban_nav convert kitti sequences/06 -o kitti06.bag",
                      "urban_nav convert new-college MOOSLog_3_11_2008_____13_43_32 -o college.bag"};
  command.more_help = commonHelp;
  command.run = runConvert;
  return command;
}

}  // namespace urban_nav
