// SPDX-License-Identifier: BSD-3-Clause
#include "training/calibration_samples.hpp"

#include <cmath>
#include <optional>

namespace fabmap_node {
namespace {

constexpr std::ptrdiff_t kNearObservations = 1;  // neighbours in the drive that show the same place
// Places between MatcherOptions::elsewhere and this multiple of it are wrong, although much of the same street is
// visible; later ones may be another lap.
constexpr urban_nav_core::StampNs kSameStreet = 4;

WordSets observationsWithout(const std::vector<DescribedDrive>& drives, std::size_t a, std::size_t b,
                             std::size_t words) {
  WordSets sets{words, {}};
  for (std::size_t d = 0; d < drives.size(); ++d)
    if (d != a && d != b)
      for (const DescribedPlace& place : drives[d]) sets.observations.push_back(place.words);
  return sets;
}

std::ptrdiff_t observationsApart(std::size_t a, std::size_t b) {
  return std::abs(static_cast<std::ptrdiff_t>(a) - static_cast<std::ptrdiff_t>(b));
}

/// Adds observations of the drive in the map: against the others, then only against places further along the same
/// street.
void addWithin(const PlaceMatcher& matcher, const DescribedDrive& drive, std::size_t site,
               const MatcherOptions& options, CalibrationRuns& runs) {
  const auto apart = [&drive](std::size_t a, std::size_t b) { return std::abs(drive[a].stamp - drive[b].stamp); };
  const LabelPlace label = [&](std::size_t query, std::size_t place) -> std::optional<bool> {
    if (observationsApart(query, place) <= kNearObservations) return true;
    if (apart(query, place) > options.elsewhere) return false;
    return std::nullopt;
  };
  for (std::ptrdiff_t gap = 1; gap <= kNearObservations; ++gap) {
    runs.alone.push_back(
        {matchRun(
             matcher, drive,
             [gap](std::size_t query, std::size_t place) { return observationsApart(query, place) >= gap; }, label),
         Situation::SameDay, site});
    runs.sequence.push_back(runs.alone.back());
  }
  const AdmitPlace isNear = [&](std::size_t query, std::size_t place) {
    return apart(query, place) <= options.elsewhere;
  };
  const AdmitPlace isInStreet = [&](std::size_t query, std::size_t place) {
    return apart(query, place) < kSameStreet * options.elsewhere;
  };
  runs.alone.push_back(
      {matchRun(
           matcher, drive,
           [&](std::size_t query, std::size_t place) { return !isNear(query, place) && isInStreet(query, place); },
           [](std::size_t, std::size_t) { return std::optional<bool>(false); }),
       Situation::Elsewhere, site});
  for (MatchedRun& run : runsElsewhere(matcher, drive, isNear, isInStreet))
    runs.sequence.push_back({std::move(run), Situation::Elsewhere, site});
}

}  // namespace

CalibrationRuns calibrationRuns(const std::vector<DescribedDrive>& drives, std::size_t words, const Detector& detector,
                                const MatcherOptions& options, const std::function<void(double)>& progress) {
  CalibrationRuns runs;
  for (std::size_t map = 0; map < drives.size(); ++map) {
    const std::size_t other = (map + 1) % drives.size();
    const WordSets rest = observationsWithout(drives, map, other, words);
    if (rest.observations.empty() || drives[map].empty()) continue;
    const LikelihoodTable table(learnChowLiuTree(rest), detector, Dependence::ChowLiu);
    PlaceMatcher matcher(table, rest.observations, options);
    for (const DescribedPlace& place : drives[map]) matcher.add(place);
    addWithin(matcher, drives[map], map, options, runs);
    runs.alone.push_back({matchRun(
                              matcher, drives[other], [](std::size_t, std::size_t) { return true; },
                              [](std::size_t, std::size_t) { return std::optional<bool>(false); }),
                          Situation::Stranger, other});
    runs.sequence.push_back(runs.alone.back());
    if (progress) progress(static_cast<double>(map + 1) / static_cast<double>(drives.size()));
  }
  return runs;
}

}  // namespace fabmap_node
