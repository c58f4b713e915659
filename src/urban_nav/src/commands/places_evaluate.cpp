// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "command_line/console.hpp"
#include "command_line/json.hpp"
#include "commands/places_actions.hpp"
#include "pipeline/parameters.hpp"
#include "places/place_truth.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav {
namespace {

std::string percentage(std::size_t part, std::size_t whole) {
  if (whole == 0) return "-";
  const double tenths = std::round(1000.0 * static_cast<double>(part) / static_cast<double>(whole));
  return urban_nav_core::printNumber(tenths / 10.0) + " %";
}

std::string printScore(const PlaceScore& score, const PlaceTruth& truth, double mask) {
  return std::to_string(score.revisits) + " revisits within " + urban_nav_core::printNumber(truth.radius) + " " +
         truth.unit + " (mask " + urban_nav_core::printNumber(mask) + " s)\n" +
         "the right place is the likeliest: " + percentage(score.first, score.revisits) +
         "\nrecall at 100 % precision: " + percentage(score.found, score.revisits) +
         "\nannounced above 0.99: " + std::to_string(score.sure) +
         ", right: " + percentage(score.sure_right, score.sure) +
         "\nannounced above 0.9 up to 0.99: " + std::to_string(score.nearly) +
         ", right: " + percentage(score.nearly_right, score.nearly) + "\n";
}

std::string printCurve(const PlaceScore& score) {
  std::string text = "probability,precision,recall\n";
  for (const PlaceScore::RecallPoint& point : score.curve)
    text += urban_nav_core::printCsvRow({urban_nav_core::printNumber(point.probability),
                                         urban_nav_core::printNumber(point.precision),
                                         urban_nav_core::printNumber(point.recall)});
  return text;
}

int runEvaluatePlaces(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const fabmap_node::RecogniserOptions options = placeRecogniserOptions(arguments);
  const fabmap_node::PlaceModel model = readPlaceModel(arguments.get("MODEL"));
  std::optional<double> radius;
  if (arguments.has("radius")) radius = arguments.number("radius", 7.5, 1e-3, 1e6);
  const PlaceQuery query = queryPlaces(model, arguments.all("SRC"), arguments.all("topic"), options, console);
  const PlaceTruth truth = readPlaceTruth(arguments.get("truth"), query, radius);
  const PlaceScore score = scorePlaces(query, truth, options.mask);
  console.print(printScore(score, truth, static_cast<double>(options.mask) * 1e-9));
  if (arguments.has("curve")) urban_nav_core::writeAtomically(arguments.get("curve"), printCurve(score));
  if (arguments.has("json")) {
    Json json = Json::object();
    json["images"] = static_cast<std::int64_t>(query.rows.size());
    json["revisits"] = static_cast<std::int64_t>(score.revisits);
    json["first"] = static_cast<std::int64_t>(score.first);
    json["found_at_full_precision"] = static_cast<std::int64_t>(score.found);
    json["above_0.99"] = static_cast<std::int64_t>(score.sure);
    json["above_0.99_right"] = static_cast<std::int64_t>(score.sure_right);
    json["above_0.9"] = static_cast<std::int64_t>(score.nearly);
    json["above_0.9_right"] = static_cast<std::int64_t>(score.nearly_right);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

}  // namespace

Command placesEvaluateAction() {
  Command action;
  action.name = "evaluate";
  action.summary = "Measures precision and recall of a model against the truth.";
  action.options = {{"MODEL", "", "model of places train; default: the one of the suite", true, false, {}},
                    {"SRC", "", "folders of images, or bags: consecutive sessions", true, true, {}},
                    {"--truth", "FILE", "CSV with columns image and position, or a TUM trajectory", true, false, {}},
                    {"--radius",
                     "R",
                     "nearer is the same place (default 7.5 m for a trajectory, 3 images for positions)",
                     false,
                     false,
                     {}},
                    {"--curve", "FILE.csv", "writes precision and recall by probability", false, false, {}}};
  for (Option& option : placeQueryOptions()) action.options.push_back(std::move(option));
  for (const Option& option : {jsonOption(), configOption(), setOption(), threadsOption()})
    action.options.push_back(option);
  action.examples = {"urban_nav places evaluate city.places monday --truth monday.tum --radius 7.5"};
  action.more_help = commonHelp;
  action.run = runEvaluatePlaces;
  return action;
}

}  // namespace urban_nav
