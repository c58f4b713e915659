// SPDX-License-Identifier: BSD-3-Clause
#include "live/graph_worker.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_live/worker_loop.hpp"

namespace pose_graph {
namespace {

using namespace std::chrono_literals;
using urban_nav_core::UserError;

/// A graph that records its calls and takes time to relax.
class Note : public LiveGraph {
 public:
  struct Book {
    std::vector<urban_nav_core::StampNs> steps;
    int closures = 0, batches = 0, updates = 0, kept = 0;
    bool disagree = false;  // updates find closures that require a batch
    bool due = false;       // a batch is required
    int steps_at_batch = 0, steps_at_take = 0;
  };
  explicit Note(std::chrono::milliseconds relaxing) : relaxing_(relaxing) {}

  void add(const urban_nav_core::SessionStep& step) override {
    if (step.to <= step.from) throw UserError("step", "backwards", "");
    book.steps.push_back(step.to);
  }
  void add(const urban_nav_core::MetricClosure&) override {
    ++book.closures;
    changed_ = true;
  }
  void add(const urban_nav_core::RelativeConstraint&) override {}
  void add(const urban_nav_core::StampedPose&) override {}
  void add(const SpecificForce&) override {}
  void add(const GroundNormal&) override {}
  void add(const PositionFix&) override {}
  bool isRelaxationPending() const override { return changed_; }
  Outcome relax() override {
    std::this_thread::sleep_for(relaxing_);
    ++book.updates;
    changed_ = false;
    Outcome outcome;
    outcome.needs_batch = book.disagree;
    return outcome;
  }
  bool isBatchPending() const override { return book.due; }
  struct Work : LiveGraph::Batch {
    explicit Work(std::chrono::milliseconds taken) : time(taken) {}
    void run(const std::atomic<bool>& stop) override {
      const auto end = std::chrono::steady_clock::now() + time;
      while (!stop && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
      if (time == 77ms) throw std::runtime_error("out of memory");
    }
    const std::chrono::milliseconds time;
  };
  std::unique_ptr<LiveGraph::Batch> beginBatch() override {
    book.due = false;
    book.steps_at_batch = static_cast<int>(book.steps.size());
    return std::make_unique<Work>(relaxing_);
  }
  std::optional<Outcome> finishBatch(const LiveGraph::Batch&) override {
    ++book.batches;
    book.steps_at_take = static_cast<int>(book.steps.size());
    if (book.due) return std::nullopt;
    Outcome outcome;
    outcome.figures.poses = book.steps_at_batch;
    return outcome;
  }
  void syncStore() override { ++book.kept; }
  urban_nav_live::StoreState storeState() const override { return {}; }
  urban_nav_core::Status status() const override { return {}; }
  std::int64_t revision() const override { return 0; }
  urban_nav_core::StampNs newest() const override { return book.steps.empty() ? 0 : book.steps.back(); }
  std::optional<urban_nav_core::Pose> T_map_odom() const override { return {}; }
  Picture picture() const override { return {}; }
  Trajectory trajectory(urban_nav_core::StampNs, urban_nav_core::StampNs, std::int64_t) const override { return {}; }
  EdgeReply addEdge(const Closure&) override { return {}; }
  EdgeReply removeEdge(const urban_nav_core::EdgeRef&) override { return {}; }
  DeferredTask save(const std::string&) override { return {}; }
  std::string load(const StoredGraph&) override { return {}; }
  std::string newSession(const std::string&) override { return {}; }
  void reset() override { book = {}; }

  Book book;

 private:
  std::chrono::milliseconds relaxing_;
  bool changed_ = false;
};

urban_nav_core::RelativePose step(urban_nav_core::StampNs from, urban_nav_core::StampNs to) {
  urban_nav_core::RelativePose step;
  step.from = from;
  step.to = to;
  return step;
}

/// A worker in a thread, as in a node.
class Worker {
 public:
  using Listener = GraphWorker::Listener;
  struct Counts : GraphWorker::Counts {
    std::int64_t dropped = 0;
  };
  Worker(std::unique_ptr<LiveGraph> graph, std::size_t capacity, Listener listener) : loop_(capacity) {
    listener.wake = [this] { loop_.wake(); };
    worker_ = std::make_unique<GraphWorker>(std::move(graph), std::move(listener));
    urban_nav_live::WorkerLoop<GraphWorker::Input>::Steps steps;
    steps.handle = [this](GraphWorker::Input& input) { worker_->add(input); };
    steps.idle = [this] {
      worker_->step();
      return false;
    };
    loop_.start("test", steps);
  }
  ~Worker() {
    loop_.stop();
    worker_.reset();
  }
  void put(GraphWorker::Input input) { loop_.push(std::move(input)); }
  template <typename Question>
  auto ask(const Question& question, std::chrono::milliseconds timeout) {
    return loop_.ask([this, question] { return question(worker_->graph()); }, timeout);
  }
  std::future<Figures> optimize() {
    return *loop_.ask([this] { return worker_->requestBatch(); }, 10s);
  }
  Counts counts() {
    return {*loop_.ask([this] { return worker_->counts(); }, 10s), loop_.dropped()};
  }

 private:
  urban_nav_live::WorkerLoop<GraphWorker::Input> loop_;
  std::unique_ptr<GraphWorker> worker_;
};

Note::Book makeBook(Worker& worker) {
  return *worker.ask([](LiveGraph& graph) { return dynamic_cast<Note&>(graph).book; }, 10s);
}

bool set(Worker& worker, bool Note::Book::*flag) {
  return *worker.ask([flag](LiveGraph& graph) { return dynamic_cast<Note&>(graph).book.*flag = true; }, 10s);
}

TEST(GraphWorker, KeepsTheOrderAndAnswersInTurn) {
  Worker worker(std::make_unique<Note>(0ms), 100, {});
  for (int i = 0; i < 20; ++i) worker.put(step(i, i + 1));
  const Note::Book book = makeBook(worker);
  ASSERT_EQ(book.steps.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(book.steps[static_cast<std::size_t>(i)], i + 1);
  EXPECT_EQ(book.updates, 0) << "odometry alone gives nothing to relax";
}

TEST(GraphWorker, NothingWaitsForARelaxation) {
  std::atomic<int> relaxed{0};
  Worker::Listener listener;
  listener.relaxed = [&](const LiveGraph::Outcome&, const LiveGraph&, double ms) {
    EXPECT_GE(ms, 200.0);
    ++relaxed;
  };
  Worker worker(std::make_unique<Note>(200ms), 1000, listener);
  worker.put(urban_nav_core::MetricClosure());
  std::this_thread::sleep_for(50ms);  // the batch is running now
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 500; ++i) worker.put(step(i, i + 1));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 100ms);
  const Note::Book book = makeBook(worker);
  EXPECT_EQ(book.steps.size(), 500U) << "and nothing is lost";
  EXPECT_EQ(book.updates, 1);
  EXPECT_EQ(relaxed, 1);
  EXPECT_EQ(worker.counts().relaxations, 1);
  EXPECT_EQ(worker.counts().dropped, 0);
}

TEST(GraphWorker, ManyClosuresAtOnceAreOneRelaxation) {
  Worker worker(std::make_unique<Note>(100ms), 1000, {});
  for (int i = 0; i < 50; ++i) worker.put(urban_nav_core::MetricClosure());
  while (makeBook(worker).closures < 50) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(300ms);
  EXPECT_LE(makeBook(worker).updates, 3);
  EXPECT_GE(makeBook(worker).updates, 1);
}

TEST(GraphWorker, OptimizeIsABatch) {
  bool reported = false;
  Worker::Listener listener;
  listener.relaxed = [&](const LiveGraph::Outcome&, const LiveGraph&, double) { reported = true; };
  Worker worker(std::make_unique<Note>(20ms), 100, listener);
  worker.put(step(0, 1));
  const Figures figures = worker.optimize().get();
  EXPECT_TRUE(reported) << "who asked for it can rely on the topics";
  EXPECT_EQ(figures.poses, 1);
  EXPECT_GE(figures.relax_ms, 20.0);
  EXPECT_EQ(makeBook(worker).batches, 1);
}

TEST(GraphWorker, RequestsOfABatchReceiveItsResult) {
  std::future<Figures> dropped;
  {
    Worker worker(std::make_unique<Note>(77ms), 100, {});
    EXPECT_THROW(worker.optimize().get(), UserError) << "out of memory";
  }
  {
    Worker worker(std::make_unique<Note>(50ms), 100, {});
    std::future<Figures> second_result = worker.optimize();
    std::future<Figures> next = worker.optimize();
    std::this_thread::sleep_for(20ms);
    set(worker, &Note::Book::due);
    EXPECT_NO_THROW(second_result.get());
    EXPECT_NO_THROW(next.get());
    EXPECT_EQ(makeBook(worker).batches, 2) << "the first was of a graph that is gone";
  }
  {
    Worker worker(std::make_unique<Note>(60s), 100, {});
    dropped = worker.optimize();
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_THROW(dropped.get(), std::future_error);
}

TEST(GraphWorker, NothingWaitsForABatch) {
  Worker worker(std::make_unique<Note>(400ms), 100, {});
  worker.optimize();
  for (int i = 0; i < 20; ++i) worker.put(step(i, i + 1));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(makeBook(worker).steps.size(), 20U);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 300ms);
  EXPECT_EQ(makeBook(worker).batches, 0) << "it is still at work";
  while (makeBook(worker).batches == 0) std::this_thread::sleep_for(1ms);
  EXPECT_LE(makeBook(worker).steps_at_batch, 20);
  EXPECT_EQ(makeBook(worker).steps_at_take, 20);
  EXPECT_EQ(worker.counts().relaxations, 1);
}

TEST(GraphWorker, ABatchRequestedWhileRunningIsRepeated) {
  Worker worker(std::make_unique<Note>(50ms), 100, {});
  set(worker, &Note::Book::due);
  std::this_thread::sleep_for(20ms);
  set(worker, &Note::Book::due);
  while (worker.counts().relaxations == 0) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(makeBook(worker).batches, 2);
  EXPECT_EQ(worker.counts().relaxations, 1) << "the first one was not reported";
}

TEST(GraphWorker, AFailedBatchIsReported) {
  std::atomic<bool> reported_reason{false};
  Worker::Listener listener;
  listener.refused = [&](const std::string& why) { reported_reason = why == "out of memory"; };
  Worker worker(std::make_unique<Note>(77ms), 100, listener);
  worker.optimize();
  for (int i = 0; i < 1000 && !reported_reason; ++i) std::this_thread::sleep_for(5ms);
  EXPECT_TRUE(reported_reason);
  EXPECT_EQ(makeBook(worker).batches, 0);
}

TEST(GraphWorker, EndsInTheMiddleOfABatch) {
  const auto begin = std::chrono::steady_clock::now();
  {
    Worker worker(std::make_unique<Note>(60s), 100, {});
    worker.optimize();
    makeBook(worker);
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
}

TEST(GraphWorker, ADisagreementLeadsToOneBatch) {
  Worker worker(std::make_unique<Note>(50ms), 100, {});
  set(worker, &Note::Book::disagree);
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < 1s) {
    worker.put(urban_nav_core::MetricClosure());
    std::this_thread::sleep_for(10ms);
  }
  const Note::Book book = makeBook(worker);
  EXPECT_GE(book.batches, 1);
  EXPECT_LE(book.batches, 5) << "a fifth of the time";
  EXPECT_GT(book.updates, book.batches);
  EXPECT_GT(book.kept, 0);
}

TEST(GraphWorker, RejectedInputsAreCountedAndReported) {
  std::string reported_reason;
  Worker::Listener listener;
  listener.refused = [&](const std::string& why) { reported_reason = why; };
  Worker worker(std::make_unique<Note>(0ms), 100, listener);
  worker.put(step(5, 3));
  worker.put(step(5, 7));
  EXPECT_EQ(makeBook(worker).steps.size(), 1U);
  EXPECT_EQ(worker.counts().refused, 1);
  EXPECT_EQ(reported_reason, "step: backwards");
}

TEST(GraphWorker, AQuestionThrowsWhereItWasAsked) {
  Worker worker(std::make_unique<Note>(0ms), 100, {});
  const auto question = [](LiveGraph&) -> int { throw UserError("edge", "no such", ""); };
  EXPECT_THROW(worker.ask(question, 10s), UserError);
  EXPECT_EQ(worker.counts().refused, 0);
}

TEST(GraphWorker, APatientCallerIsNotKeptForEver) {
  Worker worker(std::make_unique<Note>(500ms), 100, {});
  worker.put(urban_nav_core::MetricClosure());
  std::this_thread::sleep_for(50ms);
  EXPECT_FALSE(worker.ask([](LiveGraph&) { return 1; }, 20ms));
  EXPECT_EQ(worker.ask([](LiveGraph&) { return 2; }, 10s), 2);
}

TEST(GraphWorker, ADroppedQuestionHasNoAnswer) {
  Worker worker(std::make_unique<Note>(300ms), 2, {});
  worker.put(urban_nav_core::MetricClosure());
  std::this_thread::sleep_for(50ms);
  std::thread crowd([&] {
    std::this_thread::sleep_for(50ms);
    for (int i = 0; i < 10; ++i) worker.put(step(i, i + 1));
  });
  EXPECT_FALSE(worker.ask([](LiveGraph&) { return 1; }, 10s));
  crowd.join();
  EXPECT_GE(worker.counts().dropped, 1);
}

TEST(GraphWorker, EndsWhileABatchRuns) {
  const auto begin = std::chrono::steady_clock::now();
  {
    Worker worker(std::make_unique<Note>(100ms), 100, {});
    worker.put(urban_nav_core::MetricClosure());
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
}

}  // namespace
}  // namespace pose_graph
