// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "topics/places/place_query.hpp"
#include "topics/places/places_actions.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/closures_csv.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav {

using urban_nav_core::ClosureRow;
using urban_nav_core::ClosureVerdict;

namespace {

int runQuery(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const double threshold = arguments.number("threshold", 0.99, 0.0, 1.0);
  const fabmap_node::RecogniserOptions options = placeRecogniserOptions(arguments);
  const fabmap_node::PlaceModel model = readPlaceModel(arguments.get("MODEL"));
  const PlaceQuery query = queryPlaces(model, arguments.all("SRC"), arguments.all("topic"), options, console);
  std::vector<ClosureRow> rows;
  std::int64_t accepted = 0;
  for (const PlaceQueryRow& found : query.rows) {
    if (!found.recognition.match) continue;
    const PlaceQueryRow& earlier = query.rows[found.matched_row];
    ClosureRow row;
    row.a = {query.sessions[earlier.session], earlier.stamp};
    row.b = {query.sessions[found.session], found.stamp};
    row.probability = found.recognition.probability;
    const bool is_accepted = row.probability > threshold;
    row.verdict = is_accepted ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
    row.reason = is_accepted ? "" : "probability below the threshold";
    accepted += is_accepted ? 1 : 0;
    rows.push_back(std::move(row));
  }
  urban_nav_core::writeAtomically(arguments.get("output"), printClosures(rows));
  console.info(std::to_string(query.rows.size()) + " images of " + std::to_string(query.sessions.size()) +
               " sessions, " + std::to_string(rows.size()) + " with an earlier place, " + std::to_string(accepted) +
               " recognised");
  if (arguments.has("json")) {
    Json json = Json::object();
    json["images"] = static_cast<std::int64_t>(query.rows.size());
    json["candidates"] = static_cast<std::int64_t>(rows.size());
    json["accepted"] = accepted;
    json["unused"] = static_cast<std::int64_t>(query.unused);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

}  // namespace

Command placesQueryAction() {
  Command action;
  action.name = "query";
  action.summary =
      "Writes the most likely earlier place of every image, with the probability that it is the same place.";
  action.options = {{"MODEL", "", "model of places train; default: the model of the suite", true, false, {}},
                    {"SRC", "", "folders of images, or bags: consecutive sessions", true, true, {}},
                    {"-o,--output",
                     "CLOSURES.csv",
                     "table to write, with the columns of closures.csv; a is the earlier place",
                     true,
                     false,
                     {}},
                    {"--threshold", "P", "verdict accepted above this probability (default 0.99)", false, false, {}}};
  for (Option& option : placeQueryOptions()) action.options.push_back(std::move(option));
  for (const Option& option : {jsonOption(), configOption(), setOption(), threadsOption()})
    action.options.push_back(option);
  action.examples = {"urban_nav places query city.places monday tuesday -o closures.csv"};
  action.more_help = commonHelp;
  action.run = runQuery;
  return action;
}

}  // namespace urban_nav
