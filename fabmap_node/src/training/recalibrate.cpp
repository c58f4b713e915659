// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/recalibrate.hpp"

#include <algorithm>
#include <cstdlib>

#include "fabmap_node/recognition/compact_look.hpp"
#include "training/matched_run.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::UserError;

constexpr double same_place = 7.5, another_place = 10.0;  // m, as closures are judged (Newman et al. 2009, Fig. 10)
constexpr std::ptrdiff_t least_gap = 2;                   // observations of one day: nearer ones are the same picture

struct LocatedPlaces {
  std::vector<DescribedPlace> places;
  std::vector<Eigen::Vector3d> positions;
};

/// `first_camera`: only its features, as a single image.
LocatedPlaces describeDay(const LocatedDay& day, std::size_t number, bool first_camera, const PlaceModel& model,
                          std::size_t look_features) {
  LocatedPlaces described;
  described.places.resize(day.size());
  urban_nav_core::forEach(day.size(), 1, [&](std::size_t i) {
    PlaceObservation observation = day[i].observation;
    if (first_camera && observation.cameras > 1) {
      auto& features = observation.features;
      features.erase(
          std::remove_if(features.begin(), features.end(), [](const PlaceFeature& f) { return f.camera != 0; }),
          features.end());
      observation.cameras = 1;
    }
    described.places[i] = {number, day[i].stamp, model.vocabulary.words(observation),
                           packLook(lookFeatures(observation, look_features))};
  });
  for (const LocatedImage& image : day) described.positions.push_back(image.position);
  return described;
}

/// Runs of the queries of one day against the map of another, or of the same one. `has_right`: right ones too.
void addDayRuns(const PlaceMatcher& matcher, const LocatedPlaces& map, const LocatedPlaces& queries, bool is_same_day,
                bool has_right, CalibrationRuns& runs) {
  const auto distance = [&](std::size_t query, std::size_t place) {
    return (queries.positions[query] - map.positions[place]).norm();
  };
  const LabelPlace label = [&](std::size_t query, std::size_t place) -> std::optional<bool> {
    const double off = distance(query, place);
    if (off <= same_place) return true;
    if (off > another_place) return false;
    return std::nullopt;
  };
  const AdmitPlace isNear = [&](std::size_t query, std::size_t place) {
    return distance(query, place) <= another_place;
  };
  if (has_right) {
    runs.alone.push_back(matchRun(
        matcher, queries.places,
        [&](std::size_t i, std::size_t place) {
          return !is_same_day ||
                 std::abs(static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(place)) >= least_gap;
        },
        label));
    runs.sequence.push_back(runs.alone.back());
  }
  runs.alone.push_back(matchRun(
      matcher, queries.places, [&](std::size_t i, std::size_t place) { return !isNear(i, place); }, label));
  for (MatchedRun& run : runsElsewhere(matcher, queries.places, isNear, [](std::size_t, std::size_t) { return true; }))
    runs.sequence.push_back(std::move(run));
}

/// `between_days`: right matches are those of other days too. Single images look in one direction: within 7.5 m two of
/// them may show different things, which is right by distance and wrong by what they show.
KindCalibration fitKind(const PlaceModel& model, const std::vector<LocatedPlaces>& days, bool between_days,
                        const MatcherOptions& options, RecalibrationReport& report) {
  const LikelihoodTable table(model.tree, model.detector, Dependence::ChowLiu);
  CalibrationRuns runs;
  for (std::size_t m = 0; m < days.size(); ++m) {
    PlaceMatcher matcher(table, model.sampled_places, options);
    for (const DescribedPlace& place : days[m].places) matcher.add(place);
    for (std::size_t q = m; q < days.size(); ++q)
      addDayRuns(matcher, days[m], days[q], m == q, m == q || between_days, runs);
  }
  KindCalibration fitted = fitRuns(runs);
  if (fitted.right == 0 || fitted.wrong == 0)
    throw UserError("calibration", "all pairs are of " + std::string(fitted.right == 0 ? "two places" : "one place"),
                    "days that revisit places, and places more than 10 m apart");
  report.right += fitted.right;
  report.wrong += fitted.wrong;
  return fitted;
}

}  // namespace

RecalibrationReport recalibrate(PlaceModel& model, const std::vector<LocatedDay>& days, const MatcherOptions& options) {
  if (days.size() < 2) throw UserError("calibration", std::to_string(days.size()) + " day", "at least two");
  RecalibrationReport report;
  const auto isPanoramic = [](const LocatedDay& day) { return !day.empty() && day.front().observation.cameras > 1; };
  std::vector<LocatedPlaces> panoramas, singles;
  for (std::size_t d = 0; d < days.size(); ++d) {
    if (isPanoramic(days[d])) panoramas.push_back(describeDay(days[d], d, false, model, options.look_features));
    singles.push_back(describeDay(days[d], d, true, model, options.look_features));
  }
  const KindCalibration single = fitKind(model, singles, false, options, report);
  const KindCalibration panorama = panoramas.size() > 1 ? fitKind(model, panoramas, true, options, report) : single;
  model.single = single.alone;
  model.single_sequence = single.sequence;
  model.panorama = panorama.alone;
  model.panorama_sequence = panorama.sequence;
  return report;
}

}  // namespace fabmap_node
