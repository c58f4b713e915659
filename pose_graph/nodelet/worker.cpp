// SPDX-License-Identifier: BSD-3-Clause
#include "worker.hpp"

#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::UserError;

namespace {

// Times its own duration, from one batch that a disagreement asks for to the next: they take a fifth of a processor at most.
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
  if (!batch_) return;
  batch_->stop = true;
  batch_->thread.join();
}

std::future<Figures> Worker::optimize() {
  auto waiter = std::make_shared<std::promise<Figures>>();
  std::future<Figures> ended = waiter->get_future();
  mailbox_.put(Task([this, waiter = std::move(waiter)](LiveGraph&) {
    batch_wanted_ = true;
    waiters_.push_back(waiter);
  }));
  return ended;
}

Worker::Counts Worker::counts() const { return {mailbox_.dropped(), refused_, relaxations_}; }

void Worker::work() {
  while (!mailbox_.closed()) {
    for (Input& input : mailbox_.takeAll(std::chrono::milliseconds(100))) {
      take(input);
      if (mailbox_.closed()) return;
    }
    if (batch_ && batch_->ended) endBatch();
    if (!batch_ && isBatchDue()) beginBatch();
    if (graph_->wantsRelaxation()) relax();
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
  } catch (const urban_nav_core::Error& error) {
    refuse(error.what());
  }
}

void Worker::refuse(const std::string& why) {
  ++refused_;
  if (listener_.refused) listener_.refused(why);
}

void Worker::relax() {
  const Clock::time_point begin = Clock::now();
  try {
    const LiveGraph::Outcome outcome = graph_->relax();
    disagreement_ = disagreement_ || outcome.needs_batch;
    tell(outcome, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
  } catch (const urban_nav_core::Error& error) {
    refuse(error.what());
  }
}

bool Worker::isBatchDue() const {
  return batch_wanted_ || graph_->wantsBatch() || (disagreement_ && Clock::now() >= batch_again_);
}

void Worker::beginBatch() {
  batch_wanted_ = disagreement_ = false;
  batch_ = std::make_unique<Batch>();
  batch_->begin = Clock::now();
  batch_->waiters = std::move(waiters_);
  waiters_.clear();
  batch_->work = graph_->batch();
  batch_->thread = std::thread([this, batch = batch_.get()] {
    try {
      batch->work->run(batch->stop);
    } catch (const std::exception& error) {
      batch->fault = error.what();
    }
    batch->took = Clock::now() - batch->begin;
    batch->ended = true;
    mailbox_.wake();
  });
}

void Worker::endBatch() {
  batch_->thread.join();
  const std::unique_ptr<Batch> batch = std::move(batch_);
  if (!batch->fault.empty()) {
    for (const auto& waiter : batch->waiters)
      waiter->set_exception(std::make_exception_ptr(UserError("", "the batch relaxation failed: " + batch->fault, "")));
    return refuse(batch->fault);
  }
  batch_again_ = batch->begin + kBatchesApart * batch->took;
  if (const std::optional<LiveGraph::Outcome> outcome = graph_->take(*batch->work)) {
    disagreement_ = disagreement_ || outcome->needs_batch;
    const Figures figures = tell(*outcome, std::chrono::duration<double, std::milli>(batch->took).count());
    for (const auto& waiter : batch->waiters) waiter->set_value(figures);
  } else if (!batch->waiters.empty()) {  // the graph has become another one meanwhile: they wait for that one's
    waiters_.insert(waiters_.begin(), batch->waiters.begin(), batch->waiters.end());
    batch_wanted_ = true;
  }
}

Figures Worker::tell(const LiveGraph::Outcome& outcome, double ms) {
  ++relaxations_;
  if (listener_.relaxed) listener_.relaxed(outcome, *graph_, ms);
  Figures figures = outcome.figures;
  figures.relax_ms = ms;
  return figures;
}

}  // namespace pose_graph
