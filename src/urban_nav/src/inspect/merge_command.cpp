// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/merge.hpp"

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "inspect/inspect.hpp"
#include "inspect/store_info.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav {

namespace {

std::string mapsSentence(std::size_t maps) {
  if (maps == 1) return "1 map\n";
  return std::to_string(maps) + " maps: urban_nav join makes one of those that show the same places\n";
}

int runMerge(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::string output = arguments.get("output");
  const urban_nav_store::MergeResult result = urban_nav_store::merge(arguments.all("STORE"), output);
  console.info(
      std::to_string(result.rows) + " rows, " + std::to_string(result.identical) + " that several files hold" +
      (result.outdated > 0 ? ", " + std::to_string(result.outdated) + " poses of an earlier relaxation left out" : ""));
  const StoreInfo info = readStoreInfo(output);
  console.print(toText(info) + mapsSentence(info.joined.size()));
  if (arguments.has("json")) {
    Json json = toJson(info);
    json["rows"] = result.rows;
    json["identical"] = result.identical;
    json["outdated"] = result.outdated;
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

}  // namespace

Command mergeCommand() {
  Command command;
  command.name = "merge";
  command.summary = "Joins session stores, of several computers or sessions, into one.";
  command.options = {{"STORE", "", "session stores; they are only read", true, true, {}},
                     {"-o,--output", "STORE", "store to write; it appears when it is complete", true, false, {}},
                     jsonOption(),
                     configOption(),
                     setOption(),
                     threadsOption()};
  command.examples = {"urban_nav merge monday/session.db tuesday/session.db -o both.db"};
  command.more_help = commonHelp;
  command.run = runMerge;
  return command;
}

}  // namespace urban_nav
