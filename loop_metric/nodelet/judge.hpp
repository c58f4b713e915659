// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "loop_metric/loop_metric.hpp"
#include "loop_metric/session_odometry.hpp"
#include "loop_metric/shared_views.hpp"
#include "loop_metric/stored_surroundings.hpp"
#include "stage_store.hpp"
#include "urban_nav_ros/mailbox.hpp"
#include "views.hpp"

namespace loop_metric {

/// Takes candidates to their verdicts in a thread of its own: each waits until the robot has driven on by what it may need (see isDue), then it is
/// measured with what the store holds, and held against those accepted before it. Thread-safe.
class Judge {
 public:
  /// What is kept has a new session; `goes_on`: behind the odometry that the store has of it.
  struct SessionBegan {
    urban_nav_store::SessionId id;
    bool goes_on = false;
  };
  struct ViewKept {
    urban_nav_core::StampNs stamp = 0;
  };
  struct Candidate {
    urban_nav_core::TopologicalClosure closure;
    std::chrono::steady_clock::time_point came;
  };
  /// All that waits is judged with what is there, and the session ends.
  struct End {
    std::shared_ptr<std::promise<void>> done;  ///< may be empty
  };
  using Input = std::variant<urban_nav_core::RelativePose, Candidate, SessionBegan, ViewKept, LaserAt, CameraAt, End>;

  /// A verdict, and what the picture of it is drawn from.
  struct Verdict {
    urban_nav_core::MetricClosure metric;
    const LoopClosure& closure;
    std::function<Keyframe(const urban_nav_core::PoseRef&)> keyframe;  ///< by the references that `closure.stereo` has
    /// What was aligned, by the moments of `closure.metric`.
    std::function<urban_nav_core::PointCloud(const urban_nav_core::PoseRef&)> cloud;
    double ms = 0.0;
  };
  /// Called in the judge's thread.
  using Listener = std::function<void(const Verdict&)>;
  struct Counts {
    std::int64_t dropped = 0;  ///< the mailbox was full
    std::int64_t waiting = 0, stereo = 0, icp = 0, rejected = 0;
    std::int64_t parts = 0;  ///< of the running session's odometry
  };

  /// `store` must outlive it. `patience`: s.
  Judge(const Parameters& parameters, double patience, StageStore& store, Listener listener);
  /// Ends when the candidate at work has its verdict; what still waits is dropped.
  ~Judge();
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  void put(Input input) { mailbox_.put(std::move(input)); }
  Counts counts() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// A session that candidates may name, as far as it is known.
  struct Known {
    urban_nav_store::SessionId id;
    SessionOdometry odometry;
    std::vector<LaserAt> lasers;
    bool has_camera = false;
  };

  void work();
  void take(Input& input);
  void takeStep(const urban_nav_core::RelativePose& step);
  void endSession(const SessionBegan* next);
  bool isDue(const Candidate& candidate) const;
  /// False where none is due.
  bool judgeNext();
  /// `by_id`: the running session is called by its id, since another one is about to run.
  void judge(const Candidate& candidate, bool by_id);
  LoopClosure measure(const urban_nav_core::TopologicalClosure& closure);
  void followStore();
  /// The moment as Surroundings call it, at the frame nearest to it.
  urban_nav_core::PoseRef resolved(const urban_nav_core::PoseRef& at);
  void name(urban_nav_core::PoseRef& at) const;
  void load(const urban_nav_store::SessionId& id);
  void renew();
  void holdAgainstEarlier(urban_nav_core::MetricClosure& metric);

  const Parameters parameters_;
  const std::chrono::duration<double> patience_;
  StageStore& store_;
  const Listener listener_;
  urban_nav_ros::Mailbox<Input> mailbox_;

  // The thread's own.
  std::optional<CameraAt> camera_;
  std::unique_ptr<LoopMetric> stage_;
  std::optional<urban_nav_store::Store> reader_;
  std::map<urban_nav_store::SessionId, Known> sessions_;
  urban_nav_store::SessionId running_;  // empty: none yet
  std::unique_ptr<StoredSurroundings> surroundings_;
  bool outdated_ = true;     // surroundings_ does not know all of sessions_
  std::string store_fault_;  // when the last candidate was measured: what waits for the disk cannot be seen
  std::deque<Candidate> waiting_;
  std::vector<urban_nav_core::MetricClosure> accepted_;  // with all that each one knows
  ToldViews told_views_;
  Clock::time_point last_step_ = Clock::now();

  std::atomic<std::int64_t> waits_{0}, stereo_{0}, icp_{0}, rejected_{0}, parts_{0};
  std::thread thread_;
};

}  // namespace loop_metric
