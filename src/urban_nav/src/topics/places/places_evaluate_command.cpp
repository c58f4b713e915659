// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "topics/places/place_evaluation.hpp"
#include "topics/places/places_actions.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav {
namespace {

std::string printCurve(const RankingScore& score) {
  std::string text = "probability,precision,recall\n";
  for (const RankingScore::RecallPoint& point : score.curve)
    text += urban_nav_core::printCsvRow({urban_nav_core::printNumber(point.score),
                                         urban_nav_core::printNumber(point.precision),
                                         urban_nav_core::printNumber(point.recall)});
  return text;
}

Json toJson(const RankingScore& score) {
  Json json = Json::object();
  json["first"] = static_cast<std::int64_t>(score.first);
  json["found_at_full_precision"] = static_cast<std::int64_t>(score.found);
  return json;
}

Json toJson(const PlaceScore& score) {
  Json json = toJson(score.ranking);
  json["above_0.99"] = static_cast<std::int64_t>(score.sure);
  json["above_0.99_right"] = static_cast<std::int64_t>(score.sure_right);
  json["above_0.9"] = static_cast<std::int64_t>(score.nearly);
  json["above_0.9_right"] = static_cast<std::int64_t>(score.nearly_right);
  json["revisits_near_announced"] = static_cast<std::int64_t>(score.near_sure);
  json["calibration_error"] = score.calibration_error;
  return json;
}

Json toJson(const PlaceEvaluation& evaluation) {
  Json json = toJson(evaluation.score);
  json["images"] = static_cast<std::int64_t>(evaluation.query.rows.size());
  json["revisits"] = static_cast<std::int64_t>(evaluation.score.ranking.revisits);
  Json evidence = Json::object(), words = Json::object(), reliability = Json::array();
  for (const PlaceEvaluation::Row& row : evaluation.rows) evidence[row.name] = toJson(row.score);
  for (const PlaceEvaluation::Curve& curve : evaluation.words) words[curve.name] = toJson(curve.score);
  for (const ReliabilityBin& bin : evaluation.score.reliability) {
    Json one = Json::object();
    one["from"] = bin.from;
    one["to"] = bin.to;
    one["claims"] = static_cast<std::int64_t>(bin.claims);
    one["stated"] = bin.stated;
    one["right"] = static_cast<std::int64_t>(bin.right);
    reliability.append(one);
  }
  json["evidence"] = evidence;
  json["words_alone"] = words;
  json["reliability"] = reliability;
  return json;
}

int runEvaluatePlaces(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const fabmap_node::RecogniserOptions options = placeRecogniserOptions(arguments);
  const fabmap_node::PlaceModel model = readPlaceModel(arguments.get("MODEL"));
  std::optional<double> radius;
  if (arguments.has("radius")) radius = arguments.number("radius", 7.5, 1e-3, 1e6);
  const PlaceRecording recording =
      recordPlaces(model, arguments.all("SRC"), arguments.all("topic"), options.matcher, console);
  Progress progress(console, "recognise", "%", 100);
  const PlaceEvaluation evaluation = evaluatePlaces(
      model, recording, options,
      [&](const PlaceQuery& query) { return readPlaceTruth(arguments.get("truth"), query, radius); },
      [&](double share) { progress.update(static_cast<std::int64_t>(100.0 * share)); });
  progress.finish(100);
  console.print(printEvaluation(evaluation));
  if (arguments.has("curve"))
    urban_nav_core::writeAtomically(arguments.get("curve"), printCurve(evaluation.score.ranking));
  if (arguments.has("output")) writeEvaluation(evaluation, recording, arguments.get("MODEL"), arguments.get("output"));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(evaluation).print());
  return 0;
}

}  // namespace

Command placesEvaluateAction() {
  Command action;
  action.name = "evaluate";
  action.summary = "Measures precision and recall of a model against the truth.";
  action.options = {{"MODEL", "", "model of places train; default: the model of the suite", true, false, {}},
                    {"SRC", "", "folders of images, or bags: consecutive sessions", true, true, {}},
                    {"--truth", "FILE", "CSV with columns image and position, or a TUM trajectory", true, false, {}},
                    {"--radius",
                     "R",
                     "largest distance of the same place (default 7.5 m for a trajectory, 3 images for positions)",
                     false,
                     false,
                     {}},
                    {"--curve", "FILE.csv", "writes precision and recall by probability", false, false, {}},
                    {"-o,--output",
                     "DIR",
                     "folder to write: report.html with the best and worst matches, precision_recall.svg, "
                     "reliability.svg, confusion.csv, confusion.png, matches.csv",
                     false,
                     false,
                     {}}};
  for (Option& option : placeQueryOptions()) action.options.push_back(std::move(option));
  for (const Option& option : {jsonOption(), configOption(), setOption(), threadsOption()})
    action.options.push_back(option);
  action.examples = {"urban_nav places evaluate city.places monday --truth monday.tum --radius 7.5"};
  action.more_help = commonHelp;
  action.run = runEvaluatePlaces;
  return action;
}

}  // namespace urban_nav
