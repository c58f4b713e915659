// SPDX-License-Identifier: BSD-3-Clause
#include "live/graph_worker.hpp"

#include <utility>

#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::Error;

namespace {

// Minimum interval between batches due to disagreements, in durations of a batch: they use at most a fifth of a
// processor.
constexpr int kBatchInterval = 5;

double toMilliseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

GraphWorker::GraphWorker(std::unique_ptr<LiveGraph> graph, Listener listener)
    : graph_(std::move(graph)), listener_(std::move(listener)) {}

GraphWorker::~GraphWorker() {
  if (!batch_) return;
  batch_->stop = true;
  batch_->thread.join();
}

void GraphWorker::add(Input& input) {
  try {
    std::visit([this](auto& item) { graph_->add(item); }, input);
  } catch (const Error& error) {
    refuse(error.what());
  }
}

void GraphWorker::step() {
  if (batch_ && batch_->ended) finishBatch();
  if (!batch_ && isBatchDue()) beginBatch();
  if (graph_->isRelaxationPending()) relax();
  graph_->syncStore();
  if (listener_.idle) listener_.idle(*graph_);
}

std::future<Figures> GraphWorker::requestBatch() {
  batch_requested_ = true;
  waiters_.push_back(std::make_shared<std::promise<Figures>>());
  return waiters_.back()->get_future();
}

void GraphWorker::refuse(const std::string& why) {
  ++refused_;
  refusal_ = why;
  if (listener_.refused) listener_.refused(why);
}

void GraphWorker::relax() {
  const Clock::time_point begin = Clock::now();
  try {
    const LiveGraph::Outcome outcome = graph_->relax();
    disagreement_ = disagreement_ || outcome.needs_batch;
    publish(outcome, toMilliseconds(Clock::now() - begin));
  } catch (const Error& error) {
    refuse(error.what());
  }
}

bool GraphWorker::isBatchDue() const {
  return batch_requested_ || graph_->isBatchPending() || (disagreement_ && Clock::now() >= next_batch_);
}

void GraphWorker::beginBatch() {
  batch_requested_ = disagreement_ = false;
  batch_ = std::make_unique<RunningBatch>();
  batch_->begin = Clock::now();
  batch_->waiters = std::exchange(waiters_, {});
  batch_->work = graph_->beginBatch();
  batch_->thread = urban_nav_core::namedThread("batch_relax", [this, batch = batch_.get()] {
    try {
      batch->work->run(batch->stop);
    } catch (const std::exception& error) {
      batch->fault = error.what();
    }
    batch->duration = Clock::now() - batch->begin;
    batch->ended = true;
    if (listener_.wake) listener_.wake();
  });
}

void GraphWorker::finishBatch() {
  batch_->thread.join();
  const std::unique_ptr<RunningBatch> batch = std::move(batch_);
  if (!batch->fault.empty()) {
    const urban_nav_core::UserError failure("", "the batch relaxation failed: " + batch->fault, "");
    for (const auto& waiter : batch->waiters) waiter->set_exception(std::make_exception_ptr(failure));
    return refuse(batch->fault);
  }
  next_batch_ = batch->begin + kBatchInterval * batch->duration;
  if (const std::optional<LiveGraph::Outcome> outcome = graph_->finishBatch(*batch->work)) {
    disagreement_ = disagreement_ || outcome->needs_batch;
    const Figures figures = publish(*outcome, toMilliseconds(batch->duration));
    for (const auto& waiter : batch->waiters) waiter->set_value(figures);
  } else if (!batch->waiters.empty()) {  // the graph was replaced: requests apply to the new one
    waiters_.insert(waiters_.begin(), batch->waiters.begin(), batch->waiters.end());
    batch_requested_ = true;
  }
}

Figures GraphWorker::publish(const LiveGraph::Outcome& outcome, double ms) {
  ++relaxations_;
  if (listener_.relaxed) listener_.relaxed(outcome, *graph_, ms);
  Figures figures = outcome.figures;
  figures.relax_ms = ms;
  figures_ = figures;
  status_ = outcome.status;
  reason_name_ = outcome.reason_name;
  return figures;
}

urban_nav_live::StageReport GraphWorker::report() const {
  const urban_nav_live::StoreState store = graph_->storeState();
  urban_nav_live::StageReport report;
  report.status = status_;
  report.reason_name = reason_name_;
  if (!store.fault.empty()) {
    report.is_error = true;
    report.summary = (status_.sentence.empty() ? std::string(toString(status_.health)) : status_.sentence) +
                     "; not stored: " + store.fault;
  }
  report.warn(graph_->warning());
  report.add("revision", figures_.revision);
  report.add("sessions", figures_.sessions);
  report.add("sessions joined to this one", figures_.sessions_joined);
  report.add("poses", figures_.poses);
  report.add("closures", figures_.closures);
  report.add("closures rejected", figures_.closures_rejected);
  report.add("closures that wait for a second one", figures_.closures_waiting);
  report.add("closures dropped: odometry never reached them", figures_.closures_given_up);
  report.add("time of the last relaxation (ms)", figures_.relax_ms);
  report.add("relaxations", relaxations_);
  report.add("refused", refused_);
  report.add("refused last", refusal_);
  addStoreFigures(store, report);
  return report;
}

}  // namespace pose_graph
