// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "live/cloud_proposals.hpp"
#include "loop_metric/candidate/closure_checks.hpp"
#include "loop_metric/loop_metric.hpp"
#include "loop_metric/place/stored_place_data.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/worker_loop.hpp"
#include "urban_nav_registration/keyframe/keyframe_builder.hpp"
#include "urban_nav_registration/session/session_odometry.hpp"
#include "urban_nav_registration/session/stored_beams.hpp"

namespace loop_metric {

/// Measures live candidates in a separate thread. Each candidate waits until the robot has driven on by the length that
/// its clouds need (isDue), is measured with the contents of the store, and is checked against earlier accepted
/// closures. Thread-safe.
class ClosureVerifier {
 public:
  /// Event: the recorder has started a session.
  struct SessionStarted {
    urban_nav_store::SessionId id;
    bool continues = false;  ///< the session continues after the odometry in the store
  };
  struct KeyframeStored {
    urban_nav_core::StampNs stamp = 0;
  };
  struct Candidate {
    urban_nav_core::TopologicalClosure closure;
    std::chrono::steady_clock::time_point received;
  };
  using Input = std::variant<urban_nav_core::RelativePose, Candidate, SessionStarted, KeyframeStored,
                             urban_nav_registration::LaserAt, urban_nav_registration::MountedCamera>;

  /// A verdict, with access to the data of its picture.
  struct Verdict {
    urban_nav_core::MetricClosure metric;
    const RegistrationAttempts& attempts;
    /// Keyframes by the references in `attempts.stereo`.
    std::function<urban_nav_registration::Keyframe(const urban_nav_core::PoseRef&)> keyframe;
    /// Clouds by the poses of `metric`.
    std::function<urban_nav_core::PointCloud(const urban_nav_core::PoseRef&)> cloud;
    double ms = 0.0;
  };
  /// Called from the verifier's thread.
  using Listener = std::function<void(const Verdict&)>;
  struct Counts {
    std::int64_t dropped = 0;  ///< inputs dropped because the queue was full
    std::int64_t waiting = 0, stereo = 0, icp = 0, rejected = 0;
    std::int64_t parts = 0;     ///< parts of the running session's odometry without gaps
    std::int64_t proposed = 0;  ///< candidates by the similarity of clouds
  };

  /// `timeout`: maximum waiting time of a candidate, s. `store` must outlive this object.
  ClosureVerifier(const Parameters& parameters, double timeout, urban_nav_live::StoreWriterLink& store,
                  Listener listener);
  /// Blocks until the current candidate is measured; drops waiting ones.
  ~ClosureVerifier() { loop_.stop(); }
  ClosureVerifier(const ClosureVerifier&) = delete;
  ClosureVerifier& operator=(const ClosureVerifier&) = delete;

  void push(Input input) { loop_.push(std::move(input)); }
  /// Ends the session: measures all waiting candidates with the stored data. Blocks. Returns false on timeout.
  bool finishSession(std::chrono::milliseconds timeout);
  Counts counts() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// Data of a session that candidates may refer to.
  struct KnownSession {
    urban_nav_store::SessionId id;
    urban_nav_registration::SessionOdometry odometry;
    std::vector<urban_nav_registration::LaserAt> lasers;
    bool has_camera = false;
    std::shared_ptr<const urban_nav_registration::KeyframeConversion> conversion = nullptr;  ///< to the current camera
  };

  void handle(Input& input);
  void addStep(const urban_nav_core::RelativePose& step);
  void setCamera(const urban_nav_registration::MountedCamera& camera);
  void endSession(const SessionStarted* next);
  bool isKnown(const urban_nav_core::PoseRef& at);
  bool isDue(const Candidate& candidate);
  /// Returns false if no candidate is due.
  bool verifyNext();
  /// `by_id`: refers to the running session by its id, since another one is about to start.
  void verify(const Candidate& candidate, bool by_id);
  void report(const Candidate& candidate, CandidateMeasurement& measurement, bool by_id, Clock::time_point begin);
  CandidateMeasurement measure(const urban_nav_core::TopologicalClosure& closure);
  void followStore();
  /// Returns the pose with the name of its part and the nearest frame of odometry.
  urban_nav_core::PoseRef resolve(const urban_nav_core::PoseRef& at);
  void restoreName(urban_nav_core::PoseRef& at) const;
  void openReader();
  void load(const urban_nav_store::SessionId& id);
  void renewPlaceData();
  /// Describes one place by its cloud, if places are proposed by clouds. Returns false if none is waiting. `ended`: the
  /// running session has no further odometry.
  bool proposeNext(bool ended = false);
  /// Returns whether closures are proposed by the clouds of 3D LiDARs: without a camera no other stage proposes any.
  bool proposesByClouds() const;

  const Parameters parameters_;
  const std::chrono::duration<double> timeout_;
  urban_nav_live::StoreWriterLink& store_;
  const Listener listener_;

  // Members used by the thread only.
  std::optional<urban_nav_registration::MountedCamera> camera_;
  std::unique_ptr<LoopMetric> stage_;
  std::optional<urban_nav_store::Store> reader_;
  std::optional<urban_nav_registration::BeamReader> beams_;  // of reader_
  std::map<urban_nav_store::SessionId, KnownSession> sessions_;
  urban_nav_store::SessionId running_;  // empty: none
  std::unique_ptr<StoredPlaceData> place_data_;
  bool outdated_ = true;     // place_data_ does not contain all of sessions_
  std::string store_fault_;  // at the last candidate: data of pending writes cannot be read
  std::deque<Candidate> waiting_;
  CloudProposals proposals_;
  bool are_stored_followed_ = false;  // places of the sessions in the store are among proposals_
  SequentialChecks checks_;
  Clock::time_point last_step_ = Clock::now();

  std::atomic<std::int64_t> waits_{0}, stereo_{0}, icp_{0}, rejected_{0}, parts_{0}, proposed_{0};
  urban_nav_live::WorkerLoop<Input> loop_;
};

}  // namespace loop_metric
