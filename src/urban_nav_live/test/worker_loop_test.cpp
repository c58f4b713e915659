// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/worker_loop.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace urban_nav_live {
namespace {

constexpr std::chrono::milliseconds kLoopWait{10000};

using Loop = WorkerLoop<int>;

Loop::Steps stepsWith(const std::function<void(int&)>& handle) {
  Loop::Steps steps;
  steps.handle = handle;
  return steps;
}

TEST(WorkerLoop, BeginsHandlesInputsInOrderAndEnds) {
  std::vector<std::string> events;  // of the worker's thread; read after it has ended
  Loop loop(10);
  loop.push(1);
  Loop::Steps steps = stepsWith([&](int& input) { events.push_back(std::to_string(input)); });
  steps.begin = [&] { events.push_back("begin"); };
  steps.end = [&] { events.push_back("end"); };
  loop.start("test", steps);
  loop.push(2);
  EXPECT_EQ(loop.ask([] { return 7; }, kLoopWait), 7);
  loop.stop();
  EXPECT_EQ(events, (std::vector<std::string>{"begin", "1", "2", "end"}));
}

TEST(WorkerLoop, BacklogIsTheShareOfWaitingInputsWithThoseAlreadyTaken) {
  std::vector<double> backlogs;
  Loop loop(8);
  loop.start("test", stepsWith([&](int&) {}));
  EXPECT_EQ(loop.ask([] { return 0; }, kLoopWait), 0);
  EXPECT_EQ(loop.backlog(), 0.0);
  loop.stop();

  Loop full(8);
  for (int i = 0; i < 4; ++i) full.push(i);
  EXPECT_EQ(full.backlog(), 0.5);
  full.start("test", stepsWith([&](int&) {
               if (backlogs.empty()) full.push(4);
               backlogs.push_back(full.backlog());
             }));
  while (full.backlog() > 0.0) std::this_thread::yield();
  full.stop();
  EXPECT_EQ(backlogs, (std::vector<double>{0.5, 0.375, 0.25, 0.125, 0.0}));
}

TEST(WorkerLoop, AQuestionIsAnsweredAfterTheInputsBeforeIt) {
  int sum = 0;
  Loop loop(100);
  for (int i = 1; i <= 10; ++i) loop.push(i);
  loop.start("test", stepsWith([&](int& input) { sum += input; }));
  EXPECT_EQ(loop.ask([&] { return sum; }, kLoopWait), 55);
}

TEST(WorkerLoop, AQuestionThrowsInTheCaller) {
  Loop loop(10);
  loop.start("test", stepsWith([](int&) {}));
  const auto question = []() -> int { throw std::runtime_error("no"); };
  EXPECT_THROW(loop.ask(question, kLoopWait), std::runtime_error);
  EXPECT_EQ(loop.ask([] { return 1; }, kLoopWait), 1);
}

TEST(WorkerLoop, AQuestionThatIsDroppedHasNoAnswer) {
  std::atomic<bool> busy{false}, done{false};
  Loop loop(1, kLoopWait);
  loop.start("test", stepsWith([&](int&) {
               busy = true;
               while (!done) std::this_thread::yield();
             }));
  loop.push(1);
  while (!busy) std::this_thread::yield();
  std::thread asker([&] {
    EXPECT_FALSE(loop.ask([] { return 1; }, kLoopWait).has_value());
    done = true;
  });
  while (!done) {  // each displaces a waiting item, eventually the question
    loop.push(2);
    std::this_thread::yield();
  }
  asker.join();
}

TEST(WorkerLoop, AQuestionAfterTheEndHasNoAnswer) {
  Loop loop(1);
  loop.start("test", stepsWith([](int&) {}));
  loop.stop();
  EXPECT_FALSE(loop.ask([] { return 1; }, kLoopWait).has_value());
}

TEST(WorkerLoop, IdlesWithoutInputsAndAtOnceWhenWoken) {
  std::atomic<int> idles{0};
  Loop loop(1, kLoopWait);
  Loop::Steps steps = stepsWith([](int&) {});
  steps.idle = [&] { return ++idles < 3; };  // busy twice: these rounds do not wait
  loop.wake();
  loop.start("test", steps);
  while (idles < 3) std::this_thread::yield();
  loop.wake();
  while (idles < 4) std::this_thread::yield();
  loop.stop();
  EXPECT_EQ(idles, 4);
}

TEST(WorkerLoop, StopsAfterTheInputAtHand) {
  std::atomic<int> handled{0};
  Loop loop(10);
  Loop::Steps steps = stepsWith([&](int&) {
    ++handled;
    while (!loop.isStopping()) std::this_thread::yield();
  });
  bool ended = false;
  steps.end = [&] { ended = true; };
  for (int i = 0; i < 5; ++i) loop.push(i);
  loop.start("test", steps);
  while (handled == 0) std::this_thread::yield();
  loop.stop();
  EXPECT_EQ(handled, 1);
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace urban_nav_live
