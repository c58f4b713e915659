// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/loops_run.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>

#include "loop_metric/candidate/closure_checks.hpp"
#include "loop_metric/loop_metric.hpp"
#include "loop_metric/place/stored_place_data.hpp"
#include "topics/loops/closure_picture.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav {

using loop_metric::StoredPlaceData;
using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_store::Store;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kRound = 32;  // candidates between two steps of the progress bar
constexpr std::size_t kStereoPictures = 4, kIcpPictures = 3, kRejectedPictures = 3;  // in the report: some 60 kB each

double closureMilliseconds(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Tools of one thread: each has its own reader of the store.
struct Worker {
  Worker(const std::string& path, const StoredPlaceData::Sessions& sessions, const loop_metric::Parameters& parameters,
         const StereoCamera& camera, const Pose& T_base_camera)
      : store(path, urban_nav_store::Access::Read),
        place_data(sessions, store.keyframes(), store.scans()),
        stage(parameters, camera, T_base_camera) {}
  Store store;
  StoredPlaceData place_data;
  loop_metric::LoopMetric stage;
};

/// Pool of workers: as many as threads have needed at once.
class Workers {
 public:
  template <typename Make>
  std::unique_ptr<Worker> take(const Make& make) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Worker> worker = std::move(idle_.back());
        idle_.pop_back();
        return worker;
      }
    }
    return make();
  }
  void give(std::unique_ptr<Worker> worker) {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(worker));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;  // guarded by mutex_
};

MetricClosure measure(Worker& worker, const MetricClosure& candidate) {
  try {
    return worker.stage.measure({candidate.a, candidate.b, candidate.probability}, worker.place_data).metric;
  } catch (const urban_nav_core::DataError& error) {  // what the store holds of this place is damaged
    MetricClosure closure;
    closure.a = candidate.a;
    closure.b = candidate.b;
    closure.probability = candidate.probability;
    closure.reason = static_cast<int>(loop_metric::LoopReason::NothingKept);
    closure.reason_name = toString(loop_metric::LoopReason::NothingKept);
    closure.sentence = error.what();
    closure.source = "loop_metric";
    return closure;
  }
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

LoopsRun runLoops(const loop_metric::Parameters& parameters, const StereoCamera& camera, const Pose& T_base_camera,
                  const std::vector<CandidateSession>& sessions, Store& store,
                  const std::vector<MetricClosure>& candidates, Console& console) {
  LoopsRun run;
  run.candidates = candidates.size();
  if (candidates.empty()) return run;
  const Clock::time_point begin = Clock::now();
  const StoredPlaceData::Sessions known =
      storedSessions(sessions, store, urban_nav_registration::MountedCamera{camera, T_base_camera});
  const auto make = [&] { return std::make_unique<Worker>(store.path(), known, parameters, camera, T_base_camera); };
  Workers workers;
  std::vector<MetricClosure> closures(candidates.size());
  std::vector<double> ms(candidates.size());
  Progress progress(console, "loops", "closures", static_cast<std::int64_t>(candidates.size()));
  for (std::size_t first = 0; first < candidates.size(); first += kRound) {
    const std::size_t count = std::min(kRound, candidates.size() - first);
    urban_nav_core::forEach(count, 4, [&](std::size_t i) {
      std::unique_ptr<Worker> worker = workers.take(make);
      const Clock::time_point since = Clock::now();
      closures[first + i] = measure(*worker, candidates[first + i]);
      ms[first + i] = closureMilliseconds(since);
      workers.give(std::move(worker));
    });
    progress.update(static_cast<std::int64_t>(first + count));
  }
  progress.finish(static_cast<std::int64_t>(candidates.size()));
  {
    const std::unique_ptr<Worker> worker = workers.take(make);
    loop_metric::applyChecks(closures, worker->place_data, parameters);
  }
  for (const MetricClosure& closure : closures) {
    if (closure.verdict != ClosureVerdict::Accepted) ++run.rejected;
    else ++(closure.method == ClosureMethod::Stereo ? run.accepted_stereo : run.accepted_icp);
  }
  run.ms_median = urban_nav_core::quantile(ms, 0.5);
  run.ms_p99 = urban_nav_core::quantile(ms, 0.99);
  run.ms = closureMilliseconds(begin);
  run.pictures = makePictures(closures, workers.take(make)->place_data, parameters.registration.cloud_half_length);
  for (const CandidateSession& session : sessions)
    if (!known.at(session.name).has_camera)
      run.warnings.push_back("views of session " + session.name +
                             " are not matched: its camera is unknown, or it kept no views");
  run.closures = std::move(closures);
  return run;
}

}  // namespace urban_nav
