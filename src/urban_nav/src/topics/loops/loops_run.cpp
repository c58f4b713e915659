// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/loops_run.hpp"

#include <algorithm>
#include <chrono>

#include "loop_metric/candidate/closure_checks.hpp"
#include "topics/loops/closure_picture.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

using loop_metric::StoredPlaceData;
using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kStereoPictures = 4, kIcpPictures = 3, kRejectedPictures = 3;  // in the report, about 60 kB each

double closureMilliseconds(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Returns at most `most` closures, evenly spread.
std::vector<const MetricClosure*> spread(const std::vector<const MetricClosure*>& closures, std::size_t most) {
  if (closures.size() <= most) return closures;
  std::vector<const MetricClosure*> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(closures[i * (closures.size() - 1) / (most - 1)]);
  return some;
}

/// Returns pictures of closures accepted by stereo, by ICP, and of rejected ones, each group spread over its closures.
std::vector<PagePicture> makePictures(const std::vector<MetricClosure>& closures, const StoredPlaceData& place_data,
                                      double way) {
  std::vector<const MetricClosure*> stereo, icp, rejected;
  for (const MetricClosure& closure : closures) {
    if (!hasPicture(closure)) continue;
    if (closure.verdict != ClosureVerdict::Accepted) rejected.push_back(&closure);
    else (closure.method == ClosureMethod::Icp ? icp : stereo).push_back(&closure);
  }
  std::vector<PagePicture> pictures;
  for (const auto& some :
       {spread(stereo, kStereoPictures), spread(icp, kIcpPictures), spread(rejected, kRejectedPictures)})
    for (const MetricClosure* closure : some)
      if (auto picture = toPicture(*closure, place_data, way)) {
        picture->caption =
            (closure->verdict == ClosureVerdict::Accepted ? "Accepted: " : "Rejected: ") + closure->sentence;
        pictures.push_back(std::move(*picture));
      }
  return pictures;
}

}  // namespace

LoopsRun runLoops(const CandidateMeasurer& measurer, const std::vector<MetricClosure>& candidates,
                  const MeasuredClosures& measured, Console& console) {
  LoopsRun run;
  run.candidates = candidates.size();
  if (candidates.empty()) return run;
  const Clock::time_point begin = Clock::now();
  std::vector<MetricClosure> closures(candidates.size()), missing;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (const auto known = measured.find({candidates[i].a, candidates[i].b}); known != measured.end()) {
      closures[i] = known->second;
      closures[i].probability = candidates[i].probability;  // within the present group
    } else {
      missing.push_back(candidates[i]);
      places.push_back(i);
    }
  }
  Progress progress(console, "loops", "closures", static_cast<std::int64_t>(missing.size()));
  MeasuredCandidates result =
      measureCandidates(measurer, missing, [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  progress.finish(static_cast<std::int64_t>(missing.size()));
  for (std::size_t i = 0; i < places.size(); ++i) closures[places[i]] = std::move(result.closures[i]);
  run.measured = closures;
  const SeveralStores stores(measurer.stores);
  const StoredPlaceData place_data(measurer.sessions, stores.keyframes(), stores.scans());
  loop_metric::applyChecks(closures, place_data, measurer.parameters);
  for (const MetricClosure& closure : closures) {
    if (closure.verdict != ClosureVerdict::Accepted) ++run.rejected;
    else ++(closure.method == ClosureMethod::Stereo ? run.accepted_stereo : run.accepted_icp);
  }
  run.ms_median = result.ms.empty() ? 0.0 : urban_nav_core::quantile(result.ms, 0.5);
  run.ms_p99 = result.ms.empty() ? 0.0 : urban_nav_core::quantile(result.ms, 0.99);
  run.ms = closureMilliseconds(begin);
  run.pictures = makePictures(closures, place_data, measurer.parameters.registration.cloud_half_length);
  for (const auto& [name, session] : measurer.sessions)
    if (!session.has_camera)
      run.warnings.push_back("views of session " + name +
                             " are not matched: its camera is unknown, or it has no views");
  run.closures = std::move(closures);
  return run;
}

}  // namespace urban_nav
