// SPDX-License-Identifier: BSD-3-Clause
#include "join/release_command.hpp"

#include "base/command_parameters.hpp"
#include "base/console.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "inspect/stores_command.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

Json listWarnings(const std::vector<std::string>& warnings, Console& console) {
  Json list = Json::array();
  for (const std::string& warning : warnings) {
    console.warn(warning);
    list.append(warning);
  }
  return list;
}

int runDifference(const std::vector<std::string>& releases, const Arguments& arguments, Console& console) {
  if (releases.size() != 2 || arguments.has("output"))
    throw UserError("urban_nav release --diff", std::to_string(releases.size()) + " releases",
                    "two releases, and no -o");
  const ReleaseDifference found =
      compareReleases(releases[0], releases[1], loadParameters(arguments).get(commandTable()).memory_mb);
  console.print("places: " + std::to_string(found.places_lost) + " lost, " + std::to_string(found.places_new) +
                " new, " + std::to_string(found.places_moved) +
                " moved\nsurfaces: " + urban_nav_core::formatNumber(found.surfaces_gone_m2, 4) + " m2 gone, " +
                urban_nav_core::formatNumber(found.surfaces_new_m2, 4) + " m2 new\n");
  Json json = Json::object({{"places_lost", found.places_lost},
                            {"places_new", found.places_new},
                            {"places_moved", found.places_moved},
                            {"surfaces_gone_m2", found.surfaces_gone_m2},
                            {"surfaces_new_m2", found.surfaces_new_m2}});
  json["warnings"] = listWarnings(found.warnings, console);
  writeSummary(arguments, json);
  return 0;
}

int runRelease(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::vector<std::string> stores = arguments.all("STORE");
  if (arguments.has("diff")) return runDifference(stores, arguments, console);
  if (stores.size() != 1 || !arguments.has("output"))
    throw UserError("urban_nav release", stores.size() != 1 ? std::to_string(stores.size()) + " stores" : "no -o",
                    "one store and -o RELEASE, or --diff and two releases");
  const ReleaseRun run = makeRelease(stores.front(), arguments.get("output"), loadParameters(arguments));
  console.print(arguments.get("output") + ": release " + std::to_string(run.head.version) + ", " +
                std::to_string(run.keyframes) + " keyframes and " + std::to_string(run.places) + " places of " +
                std::to_string(run.sessions) + " sessions, " +
                urban_nav_core::formatNumber(1e-6 * static_cast<double>(run.bytes), 3) + " MB\n");
  Json json = toJson(run);
  json["warnings"] = listWarnings(run.warnings, console);
  writeSummary(arguments, json);
  return 0;
}

}  // namespace

Json toJson(const ReleaseRun& run) {
  Json json = Json::object({{"version", run.head.version}, {"digest", run.head.digest}});
  Json& parents = json["parents"] = Json::array();
  for (const std::string& parent : run.head.parents) parents.append(parent);
  json["sessions"] = run.sessions;
  json["places"] = run.places;
  json["keyframes"] = run.keyframes;
  json["bytes"] = run.bytes;
  return json;
}

Command releaseCommand() {
  Command command = storesCommand(false);
  command.name = "release";
  command.summary = "Writes a map of bounded size for localisation, or compares two such files.";
  command.options[0].sentence = "session store; with --diff two releases";
  command.options[1] = {"-o,--output", "RELEASE", "release to write; it appears when it is complete", false, false, {}};
  command.options.insert(
      command.options.begin() + 2,
      {"--diff", "", "compare two releases: places, keyframes and sessions added and lost", false, false, {}});
  command.examples = {"urban_nav release site.db -o site.release",
                      "urban_nav release --diff monday.release site.release",
                      "urban_nav map robot.bag --localise site.release --out out"};
  command.more_help = commonHelp;
  command.run = runRelease;
  return command;
}

}  // namespace urban_nav
