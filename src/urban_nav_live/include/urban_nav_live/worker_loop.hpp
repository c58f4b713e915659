// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_live/bounded_queue.hpp"

namespace urban_nav_live {

/// Worker thread of a live stage: takes all inputs that wait, handles each, idles, and waits for more. Thread-safe.
template <typename Input>
class WorkerLoop {
 public:
  /// Called in the worker's thread. All but `handle` may be empty.
  struct Steps {
    std::function<void()> begin;  ///< once, before the first input
    std::function<void(Input&)> handle;
    /// After the inputs of each round, at least once per `period`. Returns true if there is more work: the next round
    /// does not wait for inputs.
    std::function<bool()> idle;
    std::function<void()> end;  ///< once, after the last round
  };

  /// `capacity`: number of inputs that may wait; beyond it the oldest is dropped. The thread begins with start().
  explicit WorkerLoop(std::size_t capacity = 1, std::chrono::milliseconds period = std::chrono::milliseconds(100))
      : period_(period), queue_(capacity) {}
  /// Calls stop().
  ~WorkerLoop() { stop(); }
  WorkerLoop(const WorkerLoop&) = delete;
  WorkerLoop& operator=(const WorkerLoop&) = delete;

  /// Starts the thread, with this name. Inputs that were pushed before are handled first. Requires that it has not been
  /// called before.
  void start(const std::string& name, Steps steps) {
    steps_ = std::move(steps);
    thread_ = urban_nav_core::namedThread(name, [this] { run(); });
  }
  /// Ends the thread after the input it is handling; inputs that still wait are dropped. Idempotent. Requires that the
  /// caller is not the worker.
  void stop() {
    queue_.close();
    if (thread_.joinable()) thread_.join();
  }

  void setCapacity(std::size_t capacity) { queue_.setCapacity(capacity); }
  void push(Input input) { queue_.push(Item(std::in_place_index<0>, std::move(input))); }
  /// Starts the next round at once.
  void wake() { queue_.wake(); }
  bool isStopping() const { return queue_.isClosed(); }
  /// Number of inputs and questions pushed, those dropped included.
  std::int64_t pushed() const { return queue_.pushed(); }
  /// Number of inputs and questions dropped because the queue was full.
  std::int64_t dropped() const { return queue_.dropped(); }

  /// Evaluates `question` in the worker's thread, after all inputs that were pushed before. Blocks. Returns nullopt if
  /// it was not answered within `timeout` (it may still be evaluated later) or was dropped. Throws what `question`
  /// throws. Requires that the caller is not the worker.
  template <typename Question>
  auto ask(const Question& question, std::chrono::milliseconds timeout) -> std::optional<decltype(question())> {
    using Answer = decltype(question());
    auto task = std::make_shared<std::packaged_task<Answer()>>(question);
    std::future<Answer> answer = task->get_future();
    queue_.push(Item(std::in_place_index<1>, [task = std::move(task)] { (*task)(); }));
    if (answer.wait_for(timeout) != std::future_status::ready) return std::nullopt;
    try {
      return answer.get();
    } catch (const std::future_error&) {
      return std::nullopt;  // dropped, and its promise with it
    }
  }

 private:
  using Task = std::function<void()>;
  using Item = std::variant<Input, Task>;

  void run() {
    if (steps_.begin) steps_.begin();
    bool busy = false;
    while (!queue_.isClosed()) {
      for (Item& item : queue_.takeAll(busy ? std::chrono::milliseconds(0) : period_)) {
        if (item.index() == 1) std::get<1>(item)();
        else steps_.handle(std::get<0>(item));
        if (queue_.isClosed()) break;
      }
      busy = !queue_.isClosed() && steps_.idle && steps_.idle();
    }
    if (steps_.end) steps_.end();
  }

  const std::chrono::milliseconds period_;
  BoundedQueue<Item> queue_;
  Steps steps_;  // constant while the thread runs
  std::thread thread_;
};

}  // namespace urban_nav_live
