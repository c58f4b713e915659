// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "live/live_graph.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace pose_graph {

/// Operates a live graph in the thread of its worker: adds inputs, relaxes when required, and writes to the store.
/// Batches run in a second thread; inputs do not wait for them. Not thread-safe unless stated otherwise.
class GraphWorker {
 public:
  using Input =
      std::variant<urban_nav_core::SessionStep, urban_nav_core::MetricClosure, urban_nav_core::RelativeConstraint,
                   urban_nav_core::StampedPose, SpecificForce, GroundNormal, PositionFix>;

  struct Listener {
    std::function<void(const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms)> relaxed;
    std::function<void(const LiveGraph& graph)> idle;     ///< at the end of each step()
    std::function<void(const std::string& why)> refused;  ///< reports an input that the graph rejects
    std::function<void()> wake;                           ///< a batch has ended and step() is due; called in any thread
  };
  struct Counts {
    std::int64_t refused = 0, relaxations = 0;
  };

  GraphWorker(std::unique_ptr<LiveGraph> graph, Listener listener);
  /// Stops a batch at its next iteration.
  ~GraphWorker();
  GraphWorker(const GraphWorker&) = delete;
  GraphWorker& operator=(const GraphWorker&) = delete;

  void add(Input& input);
  /// Finishes and begins batches, relaxes, and writes to the store. Call after inputs, about ten times a second.
  void step();
  /// Requests a batch with all inputs added before. The result is available after the listener was called. It is an
  /// Error if the batch failed, std::future_error if the worker was destroyed first.
  std::future<Figures> requestBatch();

  LiveGraph& graph() { return *graph_; }
  const LiveGraph& graph() const { return *graph_; }
  Counts counts() const { return {refused_, relaxations_}; }
  /// Returns the state for diagnostics: the last relaxation, and an error if data cannot be stored.
  urban_nav_live::StageReport report() const;

 private:
  void refuse(const std::string& why);
  void relax();
  bool isBatchDue() const;
  void beginBatch();
  void finishBatch();
  /// Calls the listener. Returns the figures including the relaxation time.
  Figures publish(const LiveGraph::Outcome& outcome, double ms);

  using Clock = std::chrono::steady_clock;
  using Waiters = std::vector<std::shared_ptr<std::promise<Figures>>>;
  /// A running batch. Its thread owns `work`, `duration` and `fault` until it sets `ended`.
  struct RunningBatch {
    std::unique_ptr<LiveGraph::Batch> work;
    Clock::time_point begin;
    Clock::duration duration{};
    std::string fault;
    Waiters waiters;
    std::atomic<bool> ended{false}, stop{false};
    std::thread thread;
  };

  std::unique_ptr<LiveGraph> graph_;
  const Listener listener_;
  std::unique_ptr<RunningBatch> batch_;
  bool batch_requested_ = false;
  Waiters waiters_;                 // for the requested batch
  bool disagreement_ = false;       // an update found closures that require a batch
  Clock::time_point next_batch_{};  // earliest time of a batch due to a disagreement
  std::int64_t refused_ = 0, relaxations_ = 0;
  // State of the last relaxation and input, for report().
  Figures figures_;
  urban_nav_core::Status status_;
  std::string reason_name_ = "None", refusal_;
};

}  // namespace pose_graph
