// SPDX-License-Identifier: BSD-3-Clause
#include "training/matched_run.hpp"

#include <algorithm>

#include "fabmap_node/recognition/location_filter.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t stretch_queries = 30;

std::vector<CalibrationSample> samplesAlone(const std::vector<MatchedRun>& runs) {
  std::vector<CalibrationSample> samples;
  for (const MatchedRun& run : runs)
    for (const std::vector<LabelledMatch>& matches : run)
      if (!matches.empty() && matches.front().is_same_place)
        samples.push_back({matches.front().match.evidence, *matches.front().is_same_place});
  return samples;
}

std::vector<CalibrationSample> samplesInSequence(const std::vector<MatchedRun>& runs, const PlaceCalibration& alone) {
  std::vector<CalibrationSample> samples;
  for (const MatchedRun& run : runs) {
    LocationFilter filter;
    for (const std::vector<LabelledMatch>& matches : run) {
      if (matches.empty()) continue;
      std::vector<LocationHypothesis> hypotheses;
      for (const LabelledMatch& one : matches)
        hypotheses.push_back({one.match.session, one.match.place, alone.logit(one.match.evidence)});
      const LabelledMatch& likeliest = matches[likeliestLocation(filter, hypotheses)];
      PlaceEvidence evidence = likeliest.match.evidence;
      evidence.sequence = filter.motionConsistency(likeliest.match.session, likeliest.match.place);
      if (likeliest.is_same_place) samples.push_back({evidence, *likeliest.is_same_place});
      filter.update(hypotheses);
    }
  }
  return samples;
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
  for (std::size_t begin = 0; begin < queries.size(); begin += stretch_queries) {
    const std::size_t end = std::min(queries.size(), begin + stretch_queries);
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
  fitted.alone = fitCalibration(alone);
  if (fitted.right > 0 && fitted.wrong > 0)
    fitted.sequence = fitCalibration(samplesInSequence(runs.sequence, fitted.alone));
  return fitted;
}

}  // namespace fabmap_node
