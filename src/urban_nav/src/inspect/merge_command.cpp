// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/merge.hpp"

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "inspect/inspect.hpp"
#include "inspect/store_info.hpp"
#include "inspect/stores_command.hpp"

namespace urban_nav {

namespace {

std::string mapsSentence(std::size_t maps) {
  if (maps == 1) return "1 map\n";
  return std::to_string(maps) + " maps: urban_nav join makes one map of those that show the same places\n";
}

int runMerge(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::string output = arguments.get("output");
  for (const std::string& store : arguments.all("STORE")) requireFinished(store);
  const urban_nav_store::MergeResult result = urban_nav_store::merge(arguments.all("STORE"), output);
  console.info(
      std::to_string(result.rows) + " rows, " + std::to_string(result.identical) + " that several files hold" +
      (result.outdated > 0 ? ", " + std::to_string(result.outdated) + " poses of an earlier relaxation left out" : ""));
  const StoreInfo info = readStoreInfo(output);
  console.print(toText(info) + mapsSentence(info.joined.size()));
  Json json = toJson(info);
  json["rows"] = result.rows;
  json["identical"] = result.identical;
  json["outdated"] = result.outdated;
  writeSummary(arguments, json);
  return 0;
}

}  // namespace

Command mergeCommand() {
  Command command = storesCommand(true);
  command.name = "merge";
  command.summary = "Merges the rows of session stores, of several computers or sessions, into one store.";
  command.examples = {"urban_nav merge monday/session.db tuesday/session.db -o both.db"};
  command.more_help = commonHelp;
  command.run = runMerge;
  return command;
}

}  // namespace urban_nav
