// SPDX-License-Identifier: BSD-3-Clause
#include "training/matched_run.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "fabmap_node/recognition/location_filter.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kStretchQueries = 30;

constexpr double kLeastSamples = 10.0;  // of a situation with full weight

/// Samples with their situations.
struct SituationSamples {
  std::vector<CalibrationSample> samples;
  std::vector<Situation> situations;

  void add(const LabelledMatch& match, const PlaceEvidence& evidence, const SituationRun& run) {
    if (!match.is_same_place || !match.match.has_elsewhere) return;
    samples.push_back({evidence, *match.is_same_place, 1.0, run.site});
    situations.push_back(run.situation);
  }
  /// Returns the samples with weights that give all situations the same total, separately for correct and wrong ones.
  std::vector<CalibrationSample> weighted() const {
    std::map<std::pair<bool, Situation>, double> counts;
    for (std::size_t i = 0; i < samples.size(); ++i) counts[{samples[i].is_same_place, situations[i]}] += 1.0;
    std::vector<CalibrationSample> made = samples;
    for (std::size_t i = 0; i < samples.size(); ++i)
      made[i].weight = 1.0 / std::max(kLeastSamples, counts[{samples[i].is_same_place, situations[i]}]);
    return made;
  }
};

std::vector<CalibrationSample> samplesAlone(const std::vector<SituationRun>& runs) {
  SituationSamples samples;
  for (const SituationRun& each : runs)
    for (const std::vector<LabelledMatch>& matches : each.run)
      if (!matches.empty()) samples.add(matches.front(), matches.front().match.evidence, each);
  return samples.weighted();
}

std::vector<CalibrationSample> samplesInSequence(const std::vector<SituationRun>& runs, const PlaceCalibration& alone) {
  SituationSamples samples;
  for (const SituationRun& each : runs) {
    LocationFilter filter;
    for (const std::vector<LabelledMatch>& matches : each.run) {
      if (matches.empty()) continue;
      std::vector<LocationHypothesis> hypotheses;
      for (const LabelledMatch& one : matches)
        hypotheses.push_back(
            {one.match.session, one.match.place, alone.logit(one.match.evidence), one.match.evidence.look_margin});
      const LabelledMatch& likeliest = matches[likeliestLocation(filter, hypotheses)];
      PlaceEvidence evidence = likeliest.match.evidence;
      evidence.sequence = filter.pathMargin(likeliest.match.session, likeliest.match.place);
      samples.add(likeliest, evidence, each);
      filter.update(hypotheses);
    }
  }
  return samples.weighted();
}

}  // namespace

MatchedRun matchRun(const PlaceMatcher& matcher, const std::vector<DescribedPlace>& queries, const AdmitPlace& admit,
                    const LabelPlace& label) {
  MatchedRun run(queries.size());
  urban_nav_core::forEach(queries.size(), 1, [&](std::size_t i) {
    for (const PlaceMatch& match : matcher.matches(queries[i], [&](std::size_t place) { return admit(i, place); }))
      run[i].push_back({match, label(i, match.place)});
  });
  return run;
}

std::vector<MatchedRun> runsElsewhere(const PlaceMatcher& matcher, const std::vector<DescribedPlace>& queries,
                                      const AdmitPlace& isNear, const AdmitPlace& admit) {
  std::vector<MatchedRun> runs;
  for (std::size_t begin = 0; begin < queries.size(); begin += kStretchQueries) {
    const std::size_t end = std::min(queries.size(), begin + kStretchQueries);
    std::vector<bool> is_removed(matcher.size());
    for (std::size_t place = 0; place < matcher.size(); ++place)
      for (std::size_t query = begin; query < end; ++query)
        if (isNear(query, place)) is_removed[place] = true;
    const std::vector<DescribedPlace> stretch(queries.begin() + static_cast<std::ptrdiff_t>(begin),
                                              queries.begin() + static_cast<std::ptrdiff_t>(end));
    runs.push_back(matchRun(
        matcher, stretch,
        [&](std::size_t query, std::size_t place) { return !is_removed[place] && admit(begin + query, place); },
        [](std::size_t, std::size_t) { return std::optional<bool>(false); }));
  }
  return runs;
}

KindCalibration fitRuns(const CalibrationRuns& runs) {
  KindCalibration fitted;
  const std::vector<CalibrationSample> alone = samplesAlone(runs.alone);
  for (const CalibrationSample& sample : alone) ++(sample.is_same_place ? fitted.right : fitted.wrong);
  fitted.alone_prior = choosePrior(alone);
  fitted.alone = fitCalibration(alone, fitted.alone_prior.prior_deviation);
  if (fitted.right == 0 || fitted.wrong == 0) return fitted;
  const std::vector<CalibrationSample> in_sequence = samplesInSequence(runs.sequence, fitted.alone);
  fitted.sequence_prior = choosePrior(in_sequence);
  fitted.sequence = fitCalibration(in_sequence, fitted.sequence_prior.prior_deviation);
  return fitted;
}

}  // namespace fabmap_node
