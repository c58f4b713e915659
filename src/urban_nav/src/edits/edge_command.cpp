// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "edits/edge_list.hpp"
#include "edits/edit_store.hpp"
#include "edits/edits.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

int runEdit(const Arguments& arguments, Console& console) {
  const EditResult result = editStore(arguments);
  for (const std::string& warning : result.outcome.warnings) console.warn(warning);
  console.print(describe(result));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(result.outcome).print());
  return 0;
}

int runEdge(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  if (arguments.get("ACTION") != "list") return runEdit(arguments, console);
  Store store = urban_nav_store::openForReading(arguments.get("STORE"), Access::Snapshot);
  if (!arguments.all("ARGUMENT").empty())
    throw UserError("urban_nav edge", "arguments after list", "urban_nav edge STORE list");
  console.print(listEdges(store));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), edgesAsJson(store).print());
  return 0;
}

std::vector<std::string> actionWords() {
  std::vector<std::string> words = {"list"};
  words.insert(words.end(), editActions().begin(), editActions().end());
  return words;
}

}  // namespace

Command edgeCommand() {
  Command command;
  command.name = "edge";
  command.summary =
      "Lists and edits the closures of the map of a session store: each edit is recorded and can be undone.";
  command.options = {
      {"STORE", "", "session.db of a map; the graph is relaxed again, the point map is not rendered", true, false, {}},
      {"ACTION", "",
       "list; reject ID, accept ID, remove ID (one that an edit added); measure T1 T2; assert T1 T2 --pose; pin T "
       "--at; "
       "cut SESSION T; origin T; undo [N]; redo. T: s since 1970, +S since the beginning of a session, NAME+S of that "
       "one",
       true, false, actionWords()},
      {"ARGUMENT", "", "arguments of the action", false, true, {}},
      {"--pose", "X,Y,Z,QX,QY,QZ,QW", "assert: T_a_b of base_link, m and a unit quaternion", false, false, {}},
      {"--sigma", "M,DEG", "assert: standard deviations (default 0.1,1); pin: M only (default 0.02)", false, false, {}},
      {"--at", "X,Y,Z", "pin: position of the point in map, m", false, false, {}},
      {"--geodetic",
       "LAT,LON,H",
       "pin: position of the point on WGS 84, deg and m, by the GPS fixes of the store",
       false,
       false,
       {}},
      {"--point",
       "U,V",
       "pin: pixel of the point in the left view at T, px (default: the point is base_link)",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav edge out/session.db list", "urban_nav edge out/session.db reject 12",
                      "urban_nav edge out/session.db measure day1+3.5 day2+92.1", "urban_nav edge out/session.db undo"};
  command.more_help = commonHelp;
  command.run = runEdge;
  return command;
}

}  // namespace urban_nav
