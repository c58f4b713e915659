// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "fabmap_node/training/recalibrate.hpp"
#include "fabmap_node/training/train_model.hpp"
#include "topics/places/place_query.hpp"
#include "topics/places/place_sessions.hpp"
#include "topics/places/places_actions.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

Json trainSummary(const fabmap_node::PlaceModel& model, const std::string& bytes) {
  Json json = Json::object();
  json["words"] = static_cast<std::int64_t>(model.vocabulary.size());
  json["hash"] = fabmap_node::modelHash(bytes);
  return json;
}

/// Returns the priors by calibration, with the losses of their selection.
Json priorSummary(const std::vector<fabmap_node::CalibrationPrior>& priors) {
  Json json = Json::object();
  for (const fabmap_node::CalibrationPrior& prior : priors) {
    Json losses = Json::array();
    for (const fabmap_node::HeldOutLoss& loss : prior.choice.losses)
      losses.append(Json::object({{"prior_deviation", loss.prior_deviation},
                                  {"log_loss", loss.log_loss},
                                  {"standard_error", loss.standard_error}}));
    json[prior.calibration] =
        Json::object({{"prior_deviation", prior.choice.prior_deviation}, {"held_out", std::move(losses)}});
  }
  return json;
}

Json calibrationSummary(const fabmap_node::PlaceCalibration& calibration) {
  Json weights = Json::array();
  for (const double weight : calibration.weights) weights.append(weight);
  return Json::object({{"bias", calibration.bias},
                       {"weights", std::move(weights)},
                       {"floor", calibration.floor},
                       {"ceiling", calibration.ceiling}});
}

/// Returns the calibrations of one kind of observation.
Json kindSummary(const fabmap_node::PlaceCalibration& alone,
                 const std::optional<fabmap_node::PlaceCalibration>& sequence) {
  Json json = Json::object({{"without_sequence", calibrationSummary(alone)}});
  if (sequence) json["in_sequence"] = calibrationSummary(*sequence);
  return json;
}

/// Returns the number of the site of each source by --site, in the order of first occurrence.
std::vector<std::size_t> siteNumbers(const std::vector<std::string>& names, std::size_t sources) {
  if (!names.empty() && names.size() != sources)
    throw urban_nav_core::UserError("--site", std::to_string(names.size()) + " names",
                                    std::to_string(sources) + ": one for each SRC; or none, for one site");
  std::vector<std::size_t> numbers(sources, 0);
  std::vector<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto found = std::find(known.begin(), known.end(), names[i]);
    if (found == known.end()) found = known.insert(known.end(), names[i]);
    numbers[i] = static_cast<std::size_t>(found - known.begin());
  }
  return numbers;
}

/// Fits the calibrations of an existing model with days at sites whose positions are known.
int runRecalibrate(const Arguments& arguments, Console& console) {
  const std::vector<std::string> sources = arguments.all("SRC"), truths = arguments.all("truth");
  if (truths.size() != sources.size())
    throw urban_nav_core::UserError("--truth", std::to_string(truths.size()) + " files",
                                    std::to_string(sources.size()) + ": one trajectory for each SRC");
  fabmap_node::PlaceModel model = readPlaceModel(arguments.get("calibrate"));
  std::vector<urban_nav_core::Trajectory> trajectories;
  for (const std::string& truth : truths) {
    trajectories.push_back(urban_nav_core::readTum(truth));
    if (trajectories.back().empty()) throw urban_nav_core::UserError(truth, "holds no poses", "a TUM trajectory");
  }
  const std::vector<std::size_t> site_of = siteNumbers(arguments.all("site"), sources.size());
  std::vector<fabmap_node::LocatedSite> sites(1 + *std::max_element(site_of.begin(), site_of.end()));
  std::size_t source = 0;
  readPlaceSessions(
      sources, arguments.all("topic"), console, {},
      [&](std::size_t index, const std::string&) {
        source = index;
        sites[site_of[source]].emplace_back();
      },
      [&](StampedObservation place) {
        const urban_nav_core::Trajectory& trajectory = trajectories[source];
        const urban_nav_core::Pose& T_site_base = trajectory[trajectory.nearest(place.stamp)].pose;
        sites[site_of[source]].back().push_back(
            {place.stamp, std::move(place.observation), T_site_base.t(), T_site_base.q() * Eigen::Vector3d::UnitX()});
      });
  const auto report = fabmap_node::recalibrate(model, sites, {});
  const std::string bytes = fabmap_node::printModel(model);
  urban_nav_core::writeAtomically(arguments.get("output"), bytes);
  console.info("calibrated with " + std::to_string(report.right) + " pairs of one place and " +
               std::to_string(report.wrong) + " of two; model " + fabmap_node::modelHash(bytes));
  for (const fabmap_node::CalibrationPrior& prior : report.priors)
    console.info(prior.calibration + ": weights have a prior of deviation " +
                 urban_nav_core::printNumber(prior.choice.prior_deviation) +
                 (prior.choice.losses.empty() ? ", too few sites to choose it" : ", by leaving one site out"));
  if (!arguments.has("json")) return 0;
  Json json = trainSummary(model, bytes);
  json["priors"] = priorSummary(report.priors);
  json["single_images"] = kindSummary(model.single, model.single_sequence);
  json["panoramas"] = kindSummary(model.panorama, model.panorama_sequence);
  urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  return 0;
}

int runTrain(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  if (arguments.has("calibrate")) return runRecalibrate(arguments, console);
  fabmap_node::TrainingOptions options;
  options.k_means.words = static_cast<std::size_t>(arguments.integer("words", 4000, 10, 1'000'000));
  options.sampled_places = static_cast<std::size_t>(arguments.integer("sampled", 400, 1, 1'000'000));
  options.k_means.seed = static_cast<std::uint64_t>(arguments.integer("seed", 1, 0, 1'000'000'000));
  std::vector<fabmap_node::TrainingDrive> drives;
  readPlaceSessions(
      arguments.all("SRC"), arguments.all("topic"), console, {},
      [&drives](std::size_t, const std::string&) { drives.emplace_back(); },
      [&drives](StampedObservation place) {
        drives.back().push_back({place.stamp, std::move(place.observation)});
      });
  std::unique_ptr<Progress> progress;
  std::string current;
  const auto trained = fabmap_node::trainModel(std::move(drives), options, [&](const std::string& step, double share) {
    const auto percent = static_cast<std::int64_t>(100.0 * share);
    if (step != current) {
      progress = std::make_unique<Progress>(console, step, "%", 100);
      current = step;
    }
    if (percent < 100) progress->update(percent);
    else progress->finish(percent);
  });
  const std::string bytes = fabmap_node::printModel(trained.model);
  urban_nav_core::writeAtomically(arguments.get("output"), bytes);
  const fabmap_node::TrainingReport& report = trained.report;
  console.info(std::to_string(report.observations) + " images, " + std::to_string(report.stationary) +
               " of a stationary camera left out, " + std::to_string(report.descriptors) + " descriptors, " +
               std::to_string(trained.model.vocabulary.size()) + " words; model " + fabmap_node::modelHash(bytes) +
               ", " + std::to_string(bytes.size()) + " bytes");
  if (arguments.has("json")) {
    Json json = trainSummary(trained.model, bytes);
    json["images"] = static_cast<std::int64_t>(report.observations);
    json["stationary"] = static_cast<std::int64_t>(report.stationary);
    json["descriptors"] = static_cast<std::int64_t>(report.descriptors);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

}  // namespace

Command placesTrainAction() {
  Command action;
  action.name = "train";
  action.summary = "Trains a model of places: vocabulary, Chow-Liu tree and sampled places.";
  action.options = {
      {"SRC", "", "folders of images, or bags; each is a drive through different places", true, true, {}},
      {"-o,--output", "MODEL", "model to write", true, false, {}},
      {"--words", "N", "size of the vocabulary, 10 ... 1000000 (default 4000)", false, false, {}},
      {"--features", "KIND", "detector and descriptor: upright, the only kind", false, false, {"upright"}},
      {"--sampled", "N", "observations stored for the likelihood of a new place (default 400)", false, false, {}},
      {"--calibrate",
       "MODEL",
       "only calibrate MODEL, keeping its words and tree, on days with known positions",
       false,
       false,
       {}},
      {"--truth",
       "FILE.tum",
       "with --calibrate: poses, one file for each SRC; poses of one site are in one frame",
       false,
       true,
       {}},
      {"--site",
       "NAME",
       "with --calibrate: site of each SRC; different sites have no common places (default: one site)",
       false,
       true,
       {}},
      {"--topic", "ROLE:=NAME", "topics of bags: panorama0 ... panorama4, left (default: guessed)", false, true, {}},
      {"--seed", "N", "seed of the initial cluster centres (default 1)", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  action.examples = {"urban_nav places train monday tuesday wednesday -o city.places",
                     "urban_nav places train --calibrate city.places day1.bag day2.bag --truth day1.tum --truth "
                     "day2.tum -o calibrated.places"};
  action.more_help = commonHelp;
  action.run = runTrain;
  return action;
}

}  // namespace urban_nav
