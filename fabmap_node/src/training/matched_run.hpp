// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fabmap_node/recognition/calibration.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "fabmap_node/training/prior_choice.hpp"

namespace fabmap_node {

/// Place compared with a query, with ground truth.
struct LabelledMatch {
  PlaceMatch match;
  std::optional<bool> is_same_place;  ///< nullopt: too near to be wrong and too far to be correct
};

/// Observations of one drive in order, each with its matches in a map, most probable first.
using MatchedRun = std::vector<std::vector<LabelledMatch>>;

/// Arguments: index of the query, number of the place.
using AdmitPlace = std::function<bool(std::size_t query, std::size_t place)>;
using LabelPlace = std::function<std::optional<bool>(std::size_t query, std::size_t place)>;

/// Matches queries with the places admitted by `admit`.
MatchedRun matchRun(const PlaceMatcher& matcher, const std::vector<DescribedPlace>& queries, const AdmitPlace& admit,
                    const LabelPlace& label);

/// Returns runs in which a drive leaves the map: for each interval of 30 queries, places that are `isNear` any of its
/// queries are removed from the map, so that all remaining places are wrong. The map is constant within an interval, as
/// for a robot: removing the places around each query separately would leave others that move along with it. `admit`:
/// further places to remove.
std::vector<MatchedRun> runsElsewhere(const PlaceMatcher& matcher, const std::vector<DescribedPlace>& queries,
                                      const AdmitPlace& isNear, const AdmitPlace& admit);

/// Calibrations for one kind of observation.
struct KindCalibration {
  PlaceCalibration alone;                    ///< for single observations
  std::optional<PlaceCalibration> sequence;  ///< for sequences
  PriorChoice alone_prior, sequence_prior;
  std::size_t right = 0, wrong = 0;  ///< samples of single observations
};

/// Situation of a robot, used to weight calibration runs.
enum class Situation {
  SameDay,             ///< places of its own drive
  OtherDay,            ///< places of another day
  OtherDayAmongSites,  ///< places of another day and of all other sites
  Elsewhere,           ///< part of the site that is not in the map
  Stranger,            ///< site that is not in the map, which holds all other sites
  SimilarSite,         ///< site that is not in the map, which holds the other site that resembles it most
};

struct SituationRun {
  MatchedRun run;
  Situation situation = Situation::SameDay;
  std::size_t site = 0;  ///< of the queries
};

/// Runs for calibration.
struct CalibrationRuns {
  std::vector<SituationRun> alone;     ///< independent observations; their first match is used
  std::vector<SituationRun> sequence;  ///< observations in order; the most probable place of LocationFilter is used
};

/// Fits both calibrations, each with the prior of choosePrior(); that of sequences has LocationFilter::pathMargin() as
/// further evidence. Situations have the same weight among the samples of one kind, for any number of runs. Matches in
/// a map without places elsewhere, whose margins are not known, are no samples.
KindCalibration fitRuns(const CalibrationRuns& runs);

}  // namespace fabmap_node
