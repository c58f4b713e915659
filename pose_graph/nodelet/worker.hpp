// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "live_graph.hpp"
#include "urban_nav_ros/mailbox.hpp"

namespace pose_graph {

/// One thread that hands inputs and questions to the graph in the order in which they came, relaxes when there is
/// reason to, and has the graph kept; and another one for batches, for which nothing waits. Thread-safe.
class Worker {
 public:
  using Task = std::function<void(LiveGraph&)>;
  using Input = std::variant<urban_nav_core::RelativePose, urban_nav_core::MetricClosure,
                             urban_nav_core::RelativeConstraint, urban_nav_core::StampedPose, SpecificForce, Task>;

  /// Called in the worker's thread.
  struct Listener {
    std::function<void(const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms)> relaxed;
    std::function<void(const LiveGraph& graph)> idle;  ///< whenever the mailbox is empty, ten times a second at least
    std::function<void(const std::string& why)> refused;  ///< an input that the graph did not want
  };
  struct Counts {
    std::int64_t dropped = 0;  ///< the mailbox was full
    std::int64_t refused = 0;
    std::int64_t relaxations = 0;
  };

  Worker(std::unique_ptr<LiveGraph> graph, std::size_t capacity, Listener listener);
  /// Ends when the relaxation that is under way has ended, a batch at its next step; what still waits is dropped.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void put(Input input) { mailbox_.put(std::move(input)); }
  /// A batch relaxation of all that was put in before: the graph's figures when it has ended and the listener has been told.
  /// UserError where it failed, std::future_error where it was dropped.
  std::future<Figures> optimize();
  /// What the graph answers, when its turn comes. Throws what the question throws. Empty: not within `patience`, or
  /// dropped; it may still be carried out.
  template <typename Question>
  auto ask(const Question& question, std::chrono::milliseconds patience)
      -> std::optional<decltype(question(std::declval<LiveGraph&>()))>;
  Counts counts() const;

 private:
  void work();
  void take(Input& input);
  void refuse(const std::string& why);
  void relax();
  bool isBatchDue() const;
  void beginBatch();
  void endBatch();
  /// The graph's figures, with the time that it took.
  Figures tell(const LiveGraph::Outcome& outcome, double ms);

  using Clock = std::chrono::steady_clock;
  using Waiters = std::vector<std::shared_ptr<std::promise<Figures>>>;
  /// A batch under way: its own thread has `work`, `took` and `fault` until it sets `ended`.
  struct Batch {
    std::unique_ptr<LiveGraph::Work> work;
    Clock::time_point begin;
    Clock::duration took{};
    std::string fault;
    Waiters waiters;
    std::atomic<bool> ended{false}, stop{false};
    std::thread thread;
  };

  std::unique_ptr<LiveGraph> graph_;  // the thread's own
  const Listener listener_;
  urban_nav_ros::Mailbox<Input> mailbox_;
  std::unique_ptr<Batch> batch_;  // the thread's own, and so are the next four
  bool batch_wanted_ = false;
  Waiters waiters_;                  // for the batch that is wanted
  bool disagreement_ = false;        // an update found closures that only a batch can judge
  Clock::time_point batch_again_{};  // not before, for the sake of a disagreement
  std::atomic<std::int64_t> refused_{0}, relaxations_{0};
  std::thread thread_;
};

template <typename Question>
auto Worker::ask(const Question& question, std::chrono::milliseconds patience)
    -> std::optional<decltype(question(std::declval<LiveGraph&>()))> {
  using Answer = decltype(question(std::declval<LiveGraph&>()));
  auto task = std::make_shared<std::packaged_task<Answer(LiveGraph&)>>(question);
  std::future<Answer> answer = task->get_future();
  mailbox_.put(Task([task = std::move(task)](LiveGraph& graph) { (*task)(graph); }));
  if (answer.wait_for(patience) != std::future_status::ready) return std::nullopt;
  try {
    return answer.get();
  } catch (const std::future_error&) {
    return std::nullopt;  // dropped: its promise went with it
  }
}

}  // namespace pose_graph
