// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fabmap_node/recognition/calibration.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "fabmap_node/training/prior_choice.hpp"

namespace fabmap_node {

/// Place that was compared with a query, with the truth.
struct LabelledMatch {
  PlaceMatch match;
  std::optional<bool> is_same_place;  ///< nullopt: too near to be wrong and too far to be right
};

/// Observations of one drive in order, each with its matches in a map, the most likely first.
using MatchedRun = std::vector<std::vector<LabelledMatch>>;

/// Arguments: index of the query, number of the place.
using AdmitPlace = std::function<bool(std::size_t query, std::size_t place)>;
using LabelPlace = std::function<std::optional<bool>(std::size_t query, std::size_t place)>;

/// Matches queries with the places that `admit` admits.
MatchedRun matchRun(const PlaceMatcher& matcher, const std::vector<DescribedPlace>& queries, const AdmitPlace& admit,
                    const LabelPlace& label);

/// Runs in which a drive leaves the map: for one stretch of 30 queries after the other, places that `isNear` any of its
/// queries are removed from the map. All that is left is another place. The map stays the same within a stretch, as
/// that of a robot does: places removed around each query by itself would leave others that move along with it.
/// `admit`: further places to remove.
std::vector<MatchedRun> runsElsewhere(const PlaceMatcher& matcher, const std::vector<DescribedPlace>& queries,
                                      const AdmitPlace& isNear, const AdmitPlace& admit);

/// Calibrations of one kind of observation.
struct KindCalibration {
  PlaceCalibration alone;                    ///< of an observation alone
  std::optional<PlaceCalibration> sequence;  ///< with the observations before it
  PriorChoice alone_prior, sequence_prior;
  std::size_t right = 0, wrong = 0;  ///< samples of observations alone
};

/// Situation of a robot whose runs are calibrated with.
enum class Situation {
  SameDay,    ///< places of its own drive
  OtherDay,   ///< places of another day
  Elsewhere,  ///< a stretch of the site that the map does not have
  Stranger,   ///< another site than those of the map
};

struct SituationRun {
  MatchedRun run;
  Situation situation = Situation::SameDay;
  std::size_t site = 0;  ///< of the queries
};

/// Runs to calibrate with.
struct CalibrationRuns {
  std::vector<SituationRun> alone;     ///< each observation by itself; its first match counts
  std::vector<SituationRun> sequence;  ///< observations in order; the place that LocationFilter finds likeliest counts
};

/// Fits both calibrations, each with the prior that choosePrior() finds for it; that of sequences has the consistency
/// of motion as further evidence. Situations weigh the same among the samples of one kind, however many runs they have.
KindCalibration fitRuns(const CalibrationRuns& runs);

}  // namespace fabmap_node
