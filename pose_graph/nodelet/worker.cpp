// SPDX-License-Identifier: BSD-3-Clause
#include "worker.hpp"

#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using Clock = std::chrono::steady_clock;
using urban_nav_core::UserError;

namespace {

// Times its own duration, from one batch that a disagreement asks for to the next: they take a fifth of the thread at most.
constexpr int kBatchesApart = 5;

}  // namespace

Worker::Worker(std::unique_ptr<LiveGraph> graph, std::size_t capacity, Listener listener)
    : graph_(std::move(graph)), listener_(std::move(listener)) {
  mailbox_.setCapacity(capacity);
  thread_ = std::thread([this] { work(); });
}

Worker::~Worker() {
  mailbox_.close();
  thread_.join();
}

void Worker::optimize() {
  mailbox_.put(Task([this](LiveGraph&) { batch_wanted_ = true; }));
}

Worker::Counts Worker::counts() const { return {mailbox_.dropped(), refused_, relaxations_}; }

void Worker::work() {
  while (!mailbox_.closed()) {
    for (Input& input : mailbox_.takeAll(std::chrono::milliseconds(100))) {
      take(input);
      if (mailbox_.closed()) return;
    }
    const bool batch = batch_wanted_ || (disagreement_ && Clock::now() >= batch_again_);
    if (batch || graph_->wantsRelaxation()) relax(batch);
    graph_->keep();
    if (listener_.idle) listener_.idle(*graph_);
  }
}

void Worker::take(Input& input) {
  try {
    std::visit(
        [this](auto& item) {
          if constexpr (std::is_same_v<std::decay_t<decltype(item)>, Task>) item(*graph_);
          else graph_->add(item);
        },
        input);
  } catch (const UserError& error) {
    ++refused_;
    if (listener_.refused) listener_.refused(error.what());
  }
}

void Worker::relax(bool batch) {
  const Clock::time_point begin = Clock::now();
  if (batch) batch_wanted_ = false;
  try {
    const LiveGraph::Outcome outcome = graph_->relax(batch);
    ++relaxations_;
    const Clock::duration took = Clock::now() - begin;
    const double ms = std::chrono::duration<double, std::milli>(took).count();
    disagreement_ = outcome.needs_batch || (disagreement_ && !batch);
    if (batch) batch_again_ = begin + kBatchesApart * took;
    if (listener_.relaxed) listener_.relaxed(outcome, *graph_, ms);
  } catch (const UserError& error) {
    ++refused_;
    if (listener_.refused) listener_.refused(error.what());
  }
}

}  // namespace pose_graph
