// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
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

/// Worker thread of a live stage: takes all waiting inputs, handles each, calls idle() and waits for more. Thread-safe.
template <typename Input>
class WorkerLoop {
 public:
  /// Functions called in the worker's thread. All but `handle` may be empty.
  struct Steps {
    std::function<void()> begin;  ///< once, before the first input
    std::function<void(Input&)> handle;
    /// Called after the inputs of each round, at least once per `period`. Returns true if there is more work: the next
    /// round then does not wait for inputs.
    std::function<bool()> idle;
    std::function<void()> end;  ///< once, after the last round
  };

  /// `capacity`: largest number of waiting inputs; beyond it the oldest is dropped. start() starts the thread.
  explicit WorkerLoop(std::size_t capacity = 1, std::chrono::milliseconds period = std::chrono::milliseconds(100))
      : period_(period), queue_(capacity) {}
  /// Calls stop().
  ~WorkerLoop() { stop(); }
  WorkerLoop(const WorkerLoop&) = delete;
  WorkerLoop& operator=(const WorkerLoop&) = delete;

  /// Starts the thread, with this name; it handles inputs pushed before first. Must be called once.
  void start(const std::string& name, Steps steps) {
    steps_ = std::move(steps);
    thread_ = urban_nav_core::namedThread(name, [this] { run(); });
  }
  /// Ends the thread after the current input; waiting inputs are dropped. Idempotent. Requires that the caller is not
  /// the worker.
  void stop() {
    queue_.close();
    if (thread_.joinable()) thread_.join();
  }

  void setCapacity(std::size_t capacity) { queue_.setCapacity(capacity); }
  void push(Input input) { queue_.push(Item(std::in_place_index<0>, std::move(input))); }
  /// Starts the next round at once.
  void wake() { queue_.wake(); }
  bool isStopping() const { return queue_.isClosed(); }
  /// Returns the number of inputs and questions pushed, including dropped ones.
  std::int64_t pushed() const { return queue_.pushed(); }
  /// Returns the number of inputs and questions dropped because the queue was full.
  std::int64_t dropped() const { return queue_.dropped(); }

  /// Returns the number of inputs that wait for the worker, as a share of the capacity; at most 2, since the worker
  /// takes all waiting inputs at once.
  double backlog() const {
    return static_cast<double>(taken_ + queue_.size()) / static_cast<double>(queue_.capacity());
  }

  /// Evaluates `question` in the worker's thread, after all inputs pushed before. Blocks. Returns nullopt if it was
  /// dropped or not evaluated within `timeout` (it may still be evaluated later). Rethrows the exceptions of
  /// `question`. Requires that the caller is not the worker.
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
      return std::nullopt;  // dropped together with its promise
    }
  }

 private:
  using Task = std::function<void()>;
  using Item = std::variant<Input, Task>;

  void run() {
    if (steps_.begin) steps_.begin();
    bool busy = false;
    while (!queue_.isClosed()) {
      std::deque<Item> items = queue_.takeAll(busy ? std::chrono::milliseconds(0) : period_);
      taken_ = items.size();
      for (Item& item : items) {
        --taken_;
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
  std::atomic<std::size_t> taken_{0};  // inputs that the worker has taken from the queue and not yet begun
  Steps steps_;  // constant while the thread runs
  std::thread thread_;
};

}  // namespace urban_nav_live
