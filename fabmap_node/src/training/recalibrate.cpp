// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/recalibrate.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "fabmap_node/recognition/compact_look.hpp"
#include "training/matched_run.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::UserError;

constexpr double kSamePlace = 7.5, kAnotherPlace = 10.0;  // m, criteria for closures (Newman et al. 2009, Fig. 10)
constexpr double kSameView = 3.0;                         // m; single images this near show the same place, if they
                                                          // have
constexpr double kSameDirection = 0.866;                  // at least this cosine between their directions: 30 deg
constexpr std::ptrdiff_t kLeastGap = 2;                   // observations of one day: nearer ones are nearly identical
                                                          // images

struct LocatedPlaces {
  std::vector<DescribedPlace> places;
  std::vector<Eigen::Vector3d> positions, directions;
};
using PlaceSite = std::vector<LocatedPlaces>;  // by day

/// `first_camera`: use only its features, as a single image.
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
                           packLook(selectFeatures(observation, look_features))};
  });
  for (const LocatedImage& image : day) {
    described.positions.push_back(image.position);
    described.directions.push_back(image.forward);
  }
  return described;
}

const LabelPlace kAlwaysWrong = [](std::size_t, std::size_t) { return std::optional<bool>(false); };
const AdmitPlace kEveryPlace = [](std::size_t, std::size_t) { return true; };

/// Returns the mean agreement of the first matches that have a place elsewhere; zero without any.
double meanAgreement(const MatchedRun& run) {
  double sum = 0.0, count = 0.0;
  for (const std::vector<LabelledMatch>& matches : run) {
    if (matches.empty() || !matches.front().match.has_elsewhere) continue;
    sum += matches.front().match.evidence.look;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// Calibration runs for one kind of observation.
class SiteRuns {
 public:
  SiteRuns(const PlaceModel& model, bool panoramas, const MatcherOptions& options)
      : table_(model.tree, model.detector, Dependence::ChowLiu),
        sampled_(model.sampled_places),
        panoramas_(panoramas),
        options_(options) {}

  /// Adds runs of the queries of one day against the map of another day of the site, or of the same one. Between days,
  /// also with all other sites in the map.
  void addDays(const LocatedPlaces& map, const LocatedPlaces& queries, const std::vector<PlaceSite>& sites,
               std::size_t site, bool is_same_day) {
    const auto distance = [&](std::size_t query, std::size_t place) {
      return (queries.positions[query] - map.positions[place]).norm();
    };
    const LabelPlace label = [&](std::size_t query, std::size_t place) -> std::optional<bool> {
      const double off = distance(query, place);
      if (off > kAnotherPlace) return false;
      const bool shows_other_things =
          !panoramas_ && !is_same_day &&
          (off > kSameView || queries.directions[query].dot(map.directions[place]) < kSameDirection);
      if (off > kSamePlace || shows_other_things) return std::nullopt;
      return true;
    };
    const AdmitPlace isNear = [&](std::size_t query, std::size_t place) {
      return distance(query, place) <= kAnotherPlace;
    };
    const AdmitPlace isOtherPicture = [&](std::size_t i, std::size_t place) {
      return !is_same_day || std::abs(static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(place)) >= kLeastGap;
    };
    PlaceMatcher matcher(table_, sampled_, options_);
    for (const DescribedPlace& place : map.places) matcher.add(place);
    const SituationRun run{matchRun(matcher, queries.places, isOtherPicture, label),
                           is_same_day ? Situation::SameDay : Situation::OtherDay, site};
    runs_.alone.push_back(run);
    std::vector<SituationRun> away;
    for (MatchedRun& each : runsElsewhere(matcher, queries.places, isNear, kEveryPlace))
      away.push_back({std::move(each), Situation::Elsewhere, site});
    runs_.alone.insert(runs_.alone.end(), away.begin(), away.end());
    if (is_same_day) return;  // sequences are used only between sessions
    runs_.sequence.push_back(run);
    runs_.sequence.insert(runs_.sequence.end(), away.begin(), away.end());
    addOtherSites(sites, site, matcher);
    const LabelPlace label_among_sites = [&](std::size_t query, std::size_t place) {
      return place < map.places.size() ? label(query, place) : std::optional<bool>(false);
    };
    addToBoth({matchRun(matcher, queries.places, kEveryPlace, label_among_sites), Situation::OtherDayAmongSites, site});
  }

  /// Adds runs of all days of a site against the map of all other sites, and of its first day against the first day of
  /// the other site that resembles it most.
  void addUnmapped(const std::vector<PlaceSite>& sites, std::size_t unmapped_site) {
    PlaceMatcher all(table_, sampled_, options_);
    addOtherSites(sites, unmapped_site, all);
    if (all.size() == 0 || sites[unmapped_site].empty()) return;
    for (const LocatedPlaces& day : sites[unmapped_site])
      addToBoth({matchRun(all, day.places, kEveryPlace, kAlwaysWrong), Situation::Stranger, unmapped_site});
    MatchedRun most_similar;
    for (std::size_t s = 0; s < sites.size(); ++s) {
      if (s == unmapped_site || sites[s].empty()) continue;
      PlaceMatcher one(table_, sampled_, options_);
      for (const DescribedPlace& place : sites[s].front().places) one.add(place);
      MatchedRun run = matchRun(one, sites[unmapped_site].front().places, kEveryPlace, kAlwaysWrong);
      if (meanAgreement(run) > meanAgreement(most_similar)) most_similar = std::move(run);
    }
    addToBoth({std::move(most_similar), Situation::SimilarSite, unmapped_site});
  }

  const CalibrationRuns& runs() const { return runs_; }

 private:
  void addToBoth(const SituationRun& run) {
    runs_.alone.push_back(run);
    runs_.sequence.push_back(run);
  }
  static void addOtherSites(const std::vector<PlaceSite>& sites, std::size_t site, PlaceMatcher& matcher) {
    for (std::size_t s = 0; s < sites.size(); ++s)
      if (s != site)
        for (const LocatedPlaces& day : sites[s])
          for (const DescribedPlace& place : day.places) matcher.add(place);
  }

  const LikelihoodTable table_;
  const std::vector<WordSet>& sampled_;
  const bool panoramas_;
  const MatcherOptions options_;
  CalibrationRuns runs_;
};

KindCalibration fitKind(const PlaceModel& model, const std::vector<PlaceSite>& sites, bool panoramas,
                        const MatcherOptions& options, RecalibrationReport& report) {
  SiteRuns runs(model, panoramas, options);
  for (std::size_t s = 0; s < sites.size(); ++s) {
    for (std::size_t m = 0; m < sites[s].size(); ++m)
      for (std::size_t q = m == 0 ? 0 : m + 1; q < sites[s].size(); ++q)
        runs.addDays(sites[s][m], sites[s][q], sites, s, m == q);
    runs.addUnmapped(sites, s);
  }
  KindCalibration fitted = fitRuns(runs.runs());
  if (fitted.right == 0 || fitted.wrong == 0)
    throw UserError("calibration", "all pairs are of " + std::string(fitted.right == 0 ? "two places" : "one place"),
                    "days that revisit places, and places more than 10 m apart");
  report.right += fitted.right;
  report.wrong += fitted.wrong;
  report.priors.push_back(
      {panoramas ? "panoramas without sequence" : "single images without sequence", fitted.alone_prior});
  report.priors.push_back({panoramas ? "panoramas in sequence" : "single images in sequence", fitted.sequence_prior});
  return fitted;
}

bool hasTwoDays(const std::vector<PlaceSite>& sites) {
  return std::any_of(sites.begin(), sites.end(), [](const PlaceSite& site) { return site.size() > 1; });
}

}  // namespace

RecalibrationReport recalibrate(PlaceModel& model, const std::vector<LocatedSite>& sites,
                                const MatcherOptions& options) {
  RecalibrationReport report;
  std::vector<PlaceSite> panoramas(sites.size()), singles(sites.size());
  std::size_t number = 0;
  for (std::size_t s = 0; s < sites.size(); ++s)
    for (const LocatedDay& day : sites[s]) {
      if (!day.empty() && day.front().observation.cameras > 1)
        panoramas[s].push_back(describeDay(day, number, false, model, options.look_features));
      singles[s].push_back(describeDay(day, number, true, model, options.look_features));
      ++number;
    }
  if (!hasTwoDays(singles)) throw UserError("calibration", "no site with two days", "two days at one site at least");
  const KindCalibration single = fitKind(model, singles, false, options, report);
  model.single = single.alone;
  model.single_sequence = single.sequence;
  if (!hasTwoDays(panoramas)) return report;
  const KindCalibration panorama = fitKind(model, panoramas, true, options, report);
  model.panorama = panorama.alone;
  model.panorama_sequence = panorama.sequence;
  return report;
}

}  // namespace fabmap_node
