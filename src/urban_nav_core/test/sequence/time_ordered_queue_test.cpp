// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/time_ordered_queue.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/time.hpp"

namespace urban_nav_core {
namespace {

using TestQueue = TimeOrderedQueue<int>;
using Entry = std::pair<StampNs, int>;

std::vector<Entry> drain(TestQueue& queue) {
  std::vector<Entry> out;
  while (const auto entry = queue.take()) out.emplace_back(entry->stamp, entry->stream);
  return out;
}

std::vector<Entry> threeStreams() {
  std::vector<Entry> inputs;
  for (StampNs t = 0; t < 2000; t += 50) {
    inputs.emplace_back(t * kMillisecond, 1);
    inputs.emplace_back(t * kMillisecond, 2);
  }
  for (StampNs t = 7; t < 2000; t += 36) inputs.emplace_back(t * kMillisecond, 0);
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

TEST(TimeOrderedQueue, WhateverIsShuffledWithinTheLatenessLeavesInOrder) {
  const std::vector<Entry> inputs = threeStreams();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> delay(0.0, 50.0);
  for (int run = 0; run < 20; ++run) {
    std::vector<std::pair<double, Entry>> arrivals;
    for (const Entry& input : inputs)
      arrivals.emplace_back(static_cast<double>(input.first) / kMillisecond + delay(random), input);
    std::sort(arrivals.begin(), arrivals.end());
    TestQueue queue(3, 50 * kMillisecond);
    std::vector<Entry> out;
    for (const auto& [when, input] : arrivals) {
      ASSERT_TRUE(queue.put(input.second, input.first, 0));
      for (const Entry& place : drain(queue)) out.push_back(place);
    }
    queue.finish();
    for (const Entry& place : drain(queue)) out.push_back(place);
    ASSERT_EQ(out, inputs);
  }
}

TEST(TimeOrderedQueue, TheSameOrderWhetherStreamsAreTakenAsOrderedOrNot) {
  TestQueue live(3, 100 * kMillisecond, DeliveryOrder::OrderedStreams), offline(3, 50 * kMillisecond);
  std::vector<Entry> live_out, offline_out;
  for (const Entry& input : threeStreams()) {
    live.put(input.second, input.first, 0);
    offline.put(input.second, input.first, 0);
    for (const Entry& place : drain(live)) live_out.push_back(place);
    for (const Entry& place : drain(offline)) offline_out.push_back(place);
  }
  live.finish();
  offline.finish();
  for (const Entry& place : drain(live)) live_out.push_back(place);
  for (const Entry& place : drain(offline)) offline_out.push_back(place);
  EXPECT_EQ(live_out, offline_out);
  EXPECT_EQ(live_out, threeStreams());
}

TEST(TimeOrderedQueue, OrderedStreamsLeaveAsSoonAsAllHaveComeThatFar) {
  TestQueue queue(2, 100 * kMillisecond, DeliveryOrder::OrderedStreams);
  queue.put(0, 50 * kMillisecond, 0);
  EXPECT_TRUE(drain(queue).empty());
  queue.put(1, 50 * kMillisecond, 0);
  EXPECT_EQ(drain(queue), (std::vector<Entry>{{50 * kMillisecond, 0}, {50 * kMillisecond, 1}}));
}

TEST(TimeOrderedQueue, ASilentStreamIsWaitedForNoLongerThanTheLateness) {
  TestQueue queue(2, 100 * kMillisecond, DeliveryOrder::OrderedStreams);
  queue.put(0, 0, 0);
  queue.put(0, 99 * kMillisecond, 0);
  EXPECT_TRUE(drain(queue).empty());
  queue.put(0, 100 * kMillisecond, 0);
  EXPECT_EQ(drain(queue), (std::vector<Entry>{{0, 0}}));
  EXPECT_FALSE(queue.reached(1));
  EXPECT_EQ(*queue.reached(0), 100 * kMillisecond);
}

TEST(TimeOrderedQueue, LateAndDoubledInputsAreCountedAndDropped) {
  TestQueue queue(2, 10 * kMillisecond);
  queue.put(0, 100 * kMillisecond, 0);
  queue.put(0, 120 * kMillisecond, 0);
  EXPECT_FALSE(queue.put(0, 120 * kMillisecond, 1)) << "duplicate of a waiting input";
  EXPECT_EQ(drain(queue).size(), 1U);
  EXPECT_FALSE(queue.put(0, 100 * kMillisecond, 1)) << "duplicate of a delivered input";
  EXPECT_FALSE(queue.put(1, 90 * kMillisecond, 1));
  EXPECT_TRUE(queue.put(1, 100 * kMillisecond, 1)) << "after it in the order (stamp, stream)";
  EXPECT_EQ(queue.counts(0).received, 4);
  EXPECT_EQ(queue.counts(0).duplicate, 2);
  EXPECT_EQ(queue.counts(0).late, 0);
  EXPECT_EQ(queue.counts(1).late, 1);
}

TEST(TimeOrderedQueue, OneStampFarAheadHoldsNothingUp) {
  TestQueue queue(1, 10 * kMillisecond);
  queue.put(0, 100 * kMillisecond, 0);
  queue.put(0, 100'000'000 * kMillisecond, 0);
  EXPECT_EQ(drain(queue), (std::vector<Entry>{{100 * kMillisecond, 0}}));
  queue.put(0, 150 * kMillisecond, 0);
  EXPECT_EQ(drain(queue), (std::vector<Entry>{{150 * kMillisecond, 0}}));
  EXPECT_EQ(queue.waiting(), 1U);
}

TEST(TimeOrderedQueue, AnOptionalStreamThatIsSilentIsNotWaitedFor) {
  constexpr StampNs kPeriod = 50 * kMillisecond;
  TestQueue queue(2, 100 * kMillisecond, DeliveryOrder::OrderedStreams, 1);
  const auto isHeldBack = [&](int k) {
    queue.put(1, k * kPeriod, 0);
    return drain(queue).empty() || queue.waiting() > 0;
  };
  int k = 0;
  for (; k < 20; ++k) EXPECT_TRUE(isHeldBack(k)) << "may still arrive";
  for (; k < TestQueue::kPatience + 2; ++k) isHeldBack(k);
  EXPECT_FALSE(isHeldBack(k++));
  queue.put(0, k * kPeriod - 1, 0);
  EXPECT_TRUE(isHeldBack(k)) << "arrived";
  for (int silent = 0; silent < 25; ++silent) isHeldBack(++k);
  EXPECT_FALSE(isHeldBack(++k)) << "ended";
}

TEST(TimeOrderedQueue, AnObligatoryStreamIsWaitedForAlways) {
  TestQueue queue(2, 100 * kMillisecond, DeliveryOrder::OrderedStreams);
  for (int k = 0; k < 100; ++k) {
    queue.put(1, k * 50 * kMillisecond, 0);
    drain(queue);
  }
  EXPECT_GT(queue.waiting(), 0U);
}

TEST(TimeOrderedQueue, AClockThatIsAheadMakesNoOtherStreamLate) {
  for (const DeliveryOrder delivery : {DeliveryOrder::Shuffled, DeliveryOrder::OrderedStreams}) {
    for (const StampNs ahead :
         {-1000 * kMillisecond, 0 * kMillisecond, 1000 * kMillisecond, 3'600'000 * kMillisecond}) {
      TestQueue queue(2, 50 * kMillisecond, delivery, 1, 1);
      std::size_t most = 0;
      std::vector<StampNs> leading;
      const auto take = [&] {
        for (const Entry& entry : drain(queue))
          if (entry.second == 1) leading.push_back(entry.first);
      };
      for (int k = 0; k < 3000; ++k) {
        const StampNs now = (10'000 + 10 * k) * kMillisecond;
        queue.put(0, now + ahead, 0);
        if (k % 5 == 0) queue.put(1, now, 0);
        take();
        most = std::max(most, queue.waiting());
      }
      queue.finish();
      take();
      EXPECT_EQ(leading.size(), 600U);
      EXPECT_TRUE(std::is_sorted(leading.begin(), leading.end()));
      EXPECT_EQ(queue.counts(1).late, 0);
      EXPECT_LT(most, 1100U) << "as many as arrive in kMostAhead";
    }
  }
}

TEST(TimeOrderedQueue, AStreamWithEarlyStampsIsWaitedForUpToTheLongestWait) {
  const auto dropped = [](StampNs lag) {
    TestQueue queue(2, 50 * kMillisecond, DeliveryOrder::Shuffled, 1, 1, 1000 * kMillisecond);
    std::vector<StampNs> stamps;
    const auto take = [&] {
      for (const Entry& entry : drain(queue)) stamps.push_back(entry.first);
    };
    for (int k = 0; k < 1000; ++k) {
      const StampNs now = (10'000 + 10 * k) * kMillisecond;
      queue.put(0, now - lag, 0);
      if (k % 5 == 0) queue.put(1, now, 0);
      take();
    }
    queue.finish();
    take();
    EXPECT_TRUE(std::is_sorted(stamps.begin(), stamps.end()));
    EXPECT_EQ(queue.counts(1).late, 0);
    EXPECT_EQ(stamps.size() + static_cast<std::size_t>(queue.counts(0).late), 1200U);
    return queue.counts(0).late;
  };
  EXPECT_EQ(dropped(0), 0);
  EXPECT_EQ(dropped(300 * kMillisecond), 0);
  EXPECT_EQ(dropped(900 * kMillisecond), 0);
  EXPECT_GT(dropped(2000 * kMillisecond), 900) << "dropped, and counted";
}

TEST(TimeOrderedQueue, WhatFollowsDoesNotPileUpBeforeTheFirstOfTheOthers) {
  TestQueue queue(2, 50 * kMillisecond, DeliveryOrder::OrderedStreams, 1, 1);
  for (int k = 0; k < 5000; ++k) {
    queue.put(0, (k + 1) * 10 * kMillisecond, 0);
    EXPECT_TRUE(drain(queue).empty());
  }
  EXPECT_LE(queue.waiting(), 1001U);
  EXPECT_EQ(queue.counts(0).early + static_cast<std::int64_t>(queue.waiting()), 5000);
  EXPECT_EQ(queue.counts(0).late, 0);
  queue.put(1, 49'950 * kMillisecond, 0);
  queue.put(1, 50'000 * kMillisecond, 0);
  EXPECT_FALSE(drain(queue).empty());
}

}  // namespace
}  // namespace urban_nav_core
