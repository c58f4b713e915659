// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "inspect/inspect.hpp"
#include "map/input_streams.hpp"
#include "map/preset_options.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_input/examination/diagnosis.hpp"
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav {

namespace {

urban_nav_input::SourceOptions readSourceOptions(const Arguments& arguments) {
  ParameterSet parameters = loadParameters(arguments);
  setPresetUnits(arguments, parameters);
  urban_nav_input::SourceOptions options;
  options.topics = arguments.all("topic");
  options.calibration = arguments.get("calibration");
  options.transforms = arguments.all("transform");
  addPresetTopics(arguments, options);
  options.rate = arguments.number("rate", 0.0, 0.01, 10000.0);
  apply(parameters.get(urban_nav_input::inputTable()), options);
  options.motion_input = "none";
  options.with_sweeps = true;
  return options;
}

/// Returns the line with the options of `map` that repair a finding; empty without options.
std::string repairLine(const urban_nav_input::Finding& finding) {
  if (finding.options.empty()) return "";
  std::string line = "    -> urban_nav map ...";
  for (const std::string& option : finding.options) line += " " + option;
  return line + "\n";
}

std::string toText(const urban_nav_input::Diagnosis& diagnosis) {
  std::string text = diagnosis.name + (diagnosis.kind.empty() ? "" : ": " + diagnosis.kind) + "\n";
  for (const std::string& line : diagnosis.contents) text += "  " + line + "\n";
  if (diagnosis.pairs > 0)
    text += "  " + std::to_string(diagnosis.pairs) + " stereo pairs, " + std::to_string(diagnosis.complete) +
            " complete, " + urban_nav_core::formatNumber(diagnosis.duration_s, 4) + " s at " +
            urban_nav_core::formatNumber(diagnosis.rate_hz, 3) + " Hz\n";
  for (const urban_nav_input::Finding& finding : diagnosis.findings)
    text += std::string("  ") + (finding.unusable ? "UNUSABLE " : "") + toString(finding.kind) + ": " + finding.text +
            "\n    -> " + finding.remedy + "\n" + repairLine(finding);
  if (diagnosis.findings.empty()) text += "  no defect found\n";
  return text;
}

Json toJson(const std::vector<urban_nav_input::Diagnosis>& all) {
  Json json = Json::object();
  Json sessions = Json::array();
  Json findings = Json::array();
  Json inputs = Json::array();
  bool usable = true;
  for (const urban_nav_input::Diagnosis& diagnosis : all) {
    Json session = Json::object();
    session["name"] = diagnosis.name;
    session["kind"] = diagnosis.kind;
    session["pairs"] = diagnosis.pairs;
    session["complete"] = diagnosis.complete;
    session["duration_s"] = diagnosis.duration_s;
    session["rate_hz"] = diagnosis.rate_hz;
    session["usable"] = diagnosis.isUsable();
    sessions.append(session);
    appendInputs(diagnosis.inputs, inputs);
    usable = usable && diagnosis.isUsable();
    for (const urban_nav_input::Finding& finding : diagnosis.findings) {
      Json entry = Json::object();
      entry["session"] = diagnosis.name;
      entry["kind"] = toString(finding.kind);
      entry["text"] = finding.text;
      entry["remedy"] = finding.remedy;
      entry["unusable"] = finding.unusable;
      Json& options = entry["options"] = Json::array();
      for (const std::string& option : finding.options) options.append(option);
      findings.append(entry);
    }
  }
  json["usable"] = usable;
  json["sessions"] = sessions;
  json["findings"] = findings;
  json["inputs"] = inputs;
  return json;
}

int runDoctor(const Arguments& arguments, Console& console) {
  const urban_nav_input::SourceOptions options = readSourceOptions(arguments);
  std::vector<urban_nav_input::Diagnosis> all;
  const std::vector<std::string> readable = urban_nav_input::separateUnreadable(arguments.all("INPUT"), all);
  bool usable = all.empty();
  for (const urban_nav_input::Diagnosis& diagnosis : all) console.print(toText(diagnosis));
  for (const urban_nav_input::InputSession& session :
       urban_nav_input::findSessions(readable, options.topics, options.sessions)) {
    std::optional<Progress> bar;
    std::int64_t done = 0;
    all.push_back(urban_nav_input::examine(session, options, [&](std::int64_t pairs, std::int64_t total) {
      if (!bar) bar.emplace(console, "doctor", "pairs", total);
      bar->update(done = pairs);
    }));
    if (bar) bar->finish(done);
    console.print(toText(all.back()));
    usable = usable && all.back().isUsable();
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(all).print());
  return usable ? 0 : 1;
}

}  // namespace

Command doctorCommand() {
  Command command;
  command.name = "doctor";
  command.summary =
      "Examines bags or folders before mapping and reports each defect with its remedy; exit status 1 if they cannot "
      "be used.";
  command.options = {
      {"INPUT", "", "bags, or folders of KITTI, EuRoC or New College", true, true, {}},
      {"--topic",
       "ROLE:=NAME",
       "topic of a bag: left, right, left_info, right_info, imu, points0, ... (default: guessed and printed)",
       false,
       true,
       {}},
      presetOption(),
      transformOption(),
      {"--calibration",
       "FILE",
       "if the input has none: calib.txt, or LEFT.yaml,RIGHT.yaml (camera_info)",
       false,
       false,
       {}},
      {"--rate", "HZ", "frame rate of an image folder without times.txt (default 10)", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav doctor robot.bag", "urban_nav doctor sequences/06 --json doctor.json"};
  command.more_help = [](const Arguments& arguments) {
    return presetHelp(arguments.has("help-all")) + commonHelp(arguments);
  };
  command.run = runDoctor;
  return command;
}

}  // namespace urban_nav
