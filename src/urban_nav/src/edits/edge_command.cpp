// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "edits/edge_list.hpp"
#include "edits/edit_run.hpp"
#include "edits/edits.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

std::string moveText(double metres) {
  if (metres < 0.01) return urban_nav_core::formatNumber(1e3 * metres, 3) + " mm";
  if (metres < 1.0) return urban_nav_core::formatNumber(1e2 * metres, 3) + " cm";
  return urban_nav_core::formatNumber(metres, 4) + " m";
}

std::string idList(const std::vector<std::int64_t>& ids) {
  std::string text;
  for (const std::int64_t id : ids) text += (text.empty() ? "" : ", ") + std::to_string(id);
  return text;
}

std::string figureText(const std::optional<double>& figure) {
  return figure ? urban_nav_core::formatNumber(*figure, 4) : std::string("unknown");
}

std::string toText(const EditRequest& request, const EditOutcome& outcome) {
  if (!outcome.changed) return "nothing changed: " + outcome.reason + "\n";
  std::string text = "edit " + std::to_string(*outcome.edit) +
                     (request.action == "undo"   ? " undone"
                      : request.action == "redo" ? " done again"
                                                 : " made") +
                     "; poses moved by up to " + moveText(outcome.moved.largest) + ", rms " +
                     moveText(outcome.moved.rms) + "\n";
  if (outcome.edge) text += "closure " + std::to_string(*outcome.edge) + " added\n";
  if (!outcome.contradicted_by.empty()) text += "contradicted by closures " + idList(outcome.contradicted_by) + "\n";
  text += "cost " + urban_nav_core::formatNumber(outcome.before.cost, 5) + " -> " +
          urban_nav_core::formatNumber(outcome.after.cost, 5);
  if (outcome.before.planes_over_noise || outcome.after.planes_over_noise)
    text += ", planes over noise " + figureText(outcome.before.planes_over_noise) + " -> " +
            figureText(outcome.after.planes_over_noise);
  return text + "\n";
}

Json toJson(const EditOutcome& outcome) {
  const auto optional = [](const auto& value) { return value ? Json(*value) : Json(); };
  Json json = Json::object({{"changed", outcome.changed},
                            {"reason", outcome.reason},
                            {"edit", optional(outcome.edit)},
                            {"edge", optional(outcome.edge)}});
  json["moved"] = Json::object({{"largest_m", outcome.moved.largest}, {"rms_m", outcome.moved.rms}});
  Json& ids = json["contradicted_by"] = Json::array();
  for (const std::int64_t id : outcome.contradicted_by) ids.append(id);
  json["cost_before"] = outcome.before.cost;
  json["cost_after"] = outcome.after.cost;
  json["planes_over_noise_before"] = optional(outcome.before.planes_over_noise);
  json["planes_over_noise_after"] = optional(outcome.after.planes_over_noise);
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : outcome.warnings) warnings.append(warning);
  return json;
}

/// Opens a store for an edit. Throws DataError if another program writes it: the same call succeeds later.
Store openForEditing(const std::string& path) {
  try {
    return Store(path, Access::Write);
  } catch (const UserError& error) {
    throw urban_nav_core::DataError(path, error.parts().found, error.parts().allowed);
  }
}

/// Reads the request from a store that is open for reading, so that what is refused leaves it as it is.
int runEdit(const Arguments& arguments, Console& console) {
  const std::string path = arguments.get("STORE");
  EditRequest request;
  StoredMeasurements measurements;
  {
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    measurements = readMeasurements(store);
    request = readEditRequest(arguments, store, measurements);
  }
  EditOutcome outcome;
  if (request.unchanged.empty()) {
    Store store = openForEditing(path);
    outcome = makeEdit(store, measurements, request);
    store.close();
  } else {
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    outcome = makeEdit(store, measurements, request);
  }
  for (const std::string& warning : outcome.warnings) console.warn(warning);
  console.print(toText(request, outcome));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(outcome).print());
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
  command.summary = "Lists and edits what joins the map of a session store: every edit is kept and can be undone.";
  command.options = {
      {"STORE", "", "session.db of a map; the map is relaxed again, and nothing is rendered", true, false, {}},
      {"ACTION", "",
       "list; reject ID, accept ID, remove ID (of what an edit added); measure T1 T2; assert T1 T2 --pose; pin T --at; "
       "cut SESSION T; origin T; undo [N]; redo. T: s since 1970, +S since the beginning of a session, NAME+S of that "
       "one",
       true, false, actionWords()},
      {"ARGUMENT", "", "what the action takes", false, true, {}},
      {"--pose", "X,Y,Z,QX,QY,QZ,QW", "assert: T_a_b of base_link, m and a unit quaternion", false, false, {}},
      {"--sigma",
       "M,DEG",
       "assert: standard deviations (default 0.1,1); pin: M alone (default 0.02)",
       false,
       false,
       {}},
      {"--at", "X,Y,Z", "pin: where the point lies in map, m", false, false, {}},
      {"--geodetic",
       "LAT,LON,H",
       "pin: the same on WGS 84, deg and m, by the GPS fixes of the store",
       false,
       false,
       {}},
      {"--point", "U,V", "pin: the point seen in the left view at T, px (default: base_link itself)", false, false, {}},
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
