// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "inspect/fleet_report.hpp"
#include "inspect/inspect.hpp"
#include "inspect/store_info.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/examination/input_info.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

namespace {

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

std::string toText(const urban_nav_input::InputInfo& info) {
  std::string text = info.name + ": " + info.kind + "\n";
  for (const std::string& note : info.notes) text += "  " + note + "\n";
  for (const std::string& warning : info.warnings) text += "  " + warning + "\n";
  std::size_t width = 20, type_width = 12;
  for (const urban_nav_input::StreamInfo& stream : info.streams) {
    width = std::max(width, stream.name.size() + 2);
    type_width = std::max(type_width, stream.type.size() + 2);
  }
  text += "  " + padded("topic", width) + padded("type", type_width) + padded("messages", 10) +
          padded("rate (Hz)", 11) + padded("longest gap (s)", 17) + "from ... to (s)\n";
  for (const urban_nav_input::StreamInfo& stream : info.streams) {
    text += "  " + padded(stream.name, width) + padded(stream.type, type_width) +
            padded(std::to_string(stream.messages), 10);
    if (stream.messages > 0) {
      text += padded(urban_nav_core::formatNumber(stream.rate_hz, 4), 11) +
              padded(urban_nav_core::formatNumber(stream.longest_gap_s, 3), 17) +
              urban_nav_core::printStamp(stream.first) + " ... " + urban_nav_core::printStamp(stream.last);
    }
    if (stream.backward > 0) text += "  " + std::to_string(stream.backward) + " stamps not later than the one before";
    if (!stream.undecoded.empty()) text += "  not decoded: " + stream.undecoded;
    text += "\n";
  }
  if (info.distance_m)
    text += "  distance " + urban_nav_core::formatNumber(*info.distance_m, 4) + " m (" + info.distance_of + ")\n";
  return text;
}

Json toJson(const urban_nav_input::InputInfo& info) {
  Json json = Json::object();
  json["name"] = info.name;
  json["kind"] = info.kind;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : info.warnings) warnings.append(warning);
  Json& streams = json["streams"] = Json::array();
  for (const urban_nav_input::StreamInfo& stream : info.streams) {
    Json entry = Json::object();
    entry["name"] = stream.name;
    entry["type"] = stream.type;
    entry["messages"] = stream.messages;
    entry["rate_hz"] = stream.rate_hz;
    entry["longest_gap_s"] = stream.longest_gap_s;
    entry["backward"] = stream.backward;
    entry["first_ns"] = stream.first;
    entry["last_ns"] = stream.last;
    if (!stream.undecoded.empty()) entry["undecoded"] = stream.undecoded;
    streams.append(entry);
  }
  if (info.distance_m) json["distance_m"] = *info.distance_m;
  return json;
}

int runReport(const Arguments& arguments, Console& console) {
  const std::vector<std::string> folders = arguments.all("INPUT");
  if (folders.size() != 1)
    throw urban_nav_core::UserError("--report", std::to_string(folders.size()) + " inputs", "one folder of stores");
  const Fleet fleet = readFleet(folders.front());
  urban_nav_core::writeAtomically(arguments.get("report"), renderPage(fleetPage(fleet)));
  console.info(std::to_string(fleet.sessions.size()) + " sessions");
  for (const auto& [name, reason] : fleet.unreadable) console.warn(reason);
  console.print(arguments.get("report") + "\n");
  if (arguments.has("json")) {
    Json all = Json::array();
    all.append(toJson(fleet));
    urban_nav_core::writeAtomically(arguments.get("json"), all.print());
  }
  return 0;
}

int runInfo(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  if (arguments.has("report")) return runReport(arguments, console);
  Json all = Json::array();
  for (const std::string& input : arguments.all("INPUT")) {
    if (urban_nav_store::isStore(input) || fs::path(input).extension() == ".db") {
      const StoreInfo info = readStoreInfo(input);
      console.print(toText(info));
      all.append(toJson(info));
      continue;
    }
    const urban_nav_input::InputInfo info = urban_nav_input::lookInto(input);
    console.print(toText(info));
    all.append(toJson(info));
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), all.print());
  return 0;
}

}  // namespace

Command infoCommand() {
  Command command;
  command.name = "info";
  command.summary =
      "Lists the contents of a recording, folder or session store: sessions, topics, rates, gaps, distance.";
  command.options = {
      {"INPUT", "", "recordings, folders, session stores or releases", true, true, {}},
      {"--report",
       "FILE.html",
       "one page on all stores below the folder INPUT: sessions by robot and day, why some are not joined, "
       "quality, disagreement, calibrations",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav info robot.bag out/session.db", "urban_nav info sessions --report fleet.html"};
  command.more_help = commonHelp;
  command.run = runInfo;
  return command;
}

}  // namespace urban_nav
