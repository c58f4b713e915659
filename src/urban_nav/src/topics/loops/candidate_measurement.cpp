// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/candidate_measurement.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>

#include "loop_metric/loop_metric.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/stored_beams.hpp"

namespace urban_nav {

using loop_metric::StoredPlaceData;
using urban_nav_core::MetricClosure;
using urban_nav_core::StampNs;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

using Clock = std::chrono::steady_clock;
using StoreOfSession = std::map<SessionId, Store*>;

constexpr std::size_t kRound = 32;  // candidates between two calls of `progress`

Store* findStore(const StoreOfSession& stores, const SessionId& session) {
  const auto found = stores.find(session);
  return found == stores.end() ? nullptr : found->second;
}

[[noreturn]] void refuseWriting() { throw urban_nav_core::UserError("stores of candidates", "are only read", ""); }

StoreOfSession storesBySession(const std::vector<std::unique_ptr<Store>>& stores) {
  StoreOfSession by_session;
  for (const std::unique_ptr<Store>& store : stores)
    for (const urban_nav_store::Session& session : store->sessions().all()) by_session.emplace(session.id, store.get());
  return by_session;
}

}  // namespace

class SeveralStores::Keyframes final : public urban_nav_store::KeyframeStore {
 public:
  explicit Keyframes(StoreOfSession stores) : stores_(std::move(stores)) {}
  void put(const SessionId&, const std::string&, const urban_nav_store::StoredKeyframe&) override { refuseWriting(); }
  std::optional<urban_nav_store::StoredKeyframe> get(const SessionId& session, const std::string& camera,
                                                     StampNs stamp) const override {
    Store* const store = findStore(stores_, session);
    return store == nullptr ? std::nullopt : store->keyframes().get(session, camera, stamp);
  }
  std::vector<StampNs> stamps(const SessionId& session, const std::string& camera) const override {
    Store* const store = findStore(stores_, session);
    return store == nullptr ? std::vector<StampNs>() : store->keyframes().stamps(session, camera);
  }
  std::vector<std::string> cameras(const SessionId& session) const override {
    Store* const store = findStore(stores_, session);
    return store == nullptr ? std::vector<std::string>() : store->keyframes().cameras(session);
  }

 private:
  const StoreOfSession stores_;
};

class SeveralStores::Scans final : public urban_nav_store::ScanStore {
 public:
  explicit Scans(StoreOfSession stores) : stores_(std::move(stores)) {}
  void put(const SessionId&, const std::string&, const urban_nav_core::Scan&) override { refuseWriting(); }
  std::vector<std::string> lasers(const SessionId& session) const override {
    Store* const store = findStore(stores_, session);
    return store == nullptr ? std::vector<std::string>() : urban_nav_registration::BeamReader(*store).lasers(session);
  }
  std::int64_t count(const SessionId& session, const std::string& laser) const override {
    Store* const store = findStore(stores_, session);
    return store == nullptr ? 0 : urban_nav_registration::BeamReader(*store).count(session, laser);
  }
  void forEach(const SessionId& session, const std::string& laser, StampNs from, StampNs to,
               const std::function<void(const urban_nav_core::Scan&)>& take) const override {
    if (Store* const store = findStore(stores_, session))
      urban_nav_registration::BeamReader(*store).forEach(session, laser, from, to, take);
  }

 private:
  const StoreOfSession stores_;
};

SeveralStores::SeveralStores(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) stores_.push_back(std::make_unique<Store>(path, urban_nav_store::Access::Read));
  keyframes_ = std::make_unique<Keyframes>(storesBySession(stores_));
  scans_ = std::make_unique<Scans>(storesBySession(stores_));
}

SeveralStores::~SeveralStores() = default;
const urban_nav_store::KeyframeStore& SeveralStores::keyframes() const { return *keyframes_; }
const urban_nav_store::ScanStore& SeveralStores::scans() const { return *scans_; }

namespace {

/// Tools of one thread: each has its own readers of the stores.
struct Worker {
  explicit Worker(const CandidateMeasurer& measurer)
      : stores(measurer.stores),
        place_data(measurer.sessions, stores.keyframes(), stores.scans()),
        stage(measurer.parameters, measurer.camera.camera, measurer.camera.T_base_left) {}
  SeveralStores stores;
  StoredPlaceData place_data;
  loop_metric::LoopMetric stage;
};

/// Pool of workers: as many as were used concurrently.
class Workers {
 public:
  explicit Workers(const CandidateMeasurer& measurer) : measurer_(measurer) {}
  std::unique_ptr<Worker> take() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Worker> worker = std::move(idle_.back());
        idle_.pop_back();
        return worker;
      }
    }
    return std::make_unique<Worker>(measurer_);
  }
  void give(std::unique_ptr<Worker> worker) {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(worker));
  }

 private:
  const CandidateMeasurer& measurer_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;  // guarded by mutex_
};

MetricClosure measureCandidate(Worker& worker, const MetricClosure& candidate) {
  try {
    return worker.stage.measure({candidate.a, candidate.b, candidate.probability}, worker.place_data).metric;
  } catch (const urban_nav_core::DataError& error) {  // damaged data of this place
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

}  // namespace

MeasuredCandidates measureCandidates(const CandidateMeasurer& measurer, const std::vector<MetricClosure>& candidates,
                                     const std::function<void(std::size_t)>& progress) {
  Workers workers(measurer);
  MeasuredCandidates measured;
  measured.closures.resize(candidates.size());
  measured.ms.resize(candidates.size());
  for (std::size_t first = 0; first < candidates.size(); first += kRound) {
    const std::size_t count = std::min(kRound, candidates.size() - first);
    urban_nav_core::forEach(count, 4, [&](std::size_t i) {
      std::unique_ptr<Worker> worker = workers.take();
      const Clock::time_point since = Clock::now();
      measured.closures[first + i] = measureCandidate(*worker, candidates[first + i]);
      measured.ms[first + i] = std::chrono::duration<double, std::milli>(Clock::now() - since).count();
      workers.give(std::move(worker));
    });
    progress(first + count);
  }
  return measured;
}

}  // namespace urban_nav
