// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/sweep_motion_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_core {
namespace {

using Queue = SweepMotionQueue<int>;

constexpr StampNs kQueueMs = 1'000'000;
constexpr int kSweeps = 60;

/// A message with its stamp and the time at which it arrives: a sweep of 100 ms with its number, or a motion input.
struct Message {
  StampNs stamp = 0, arrival = 0;
  int sweep = -1;
  MotionInput motion;
};

MotionInput makeInput(MotionSource source, StampNs from, StampNs to) {
  MotionInput input;
  input.source = source;
  input.from = from;
  input.to = to;
  return input;
}

/// Messages in order of arrival. `delay_ms`: most of an input.
std::vector<Message> makeMessages(double delay_ms, std::uint64_t seed) {
  testing::Dice dice(seed);
  std::vector<Message> messages;
  const auto add = [&](MotionSource source, StampNs period) {
    const StampNs delay = static_cast<StampNs>(dice.uniform(0.0, delay_ms) * kQueueMs);
    for (StampNs t = period; t < kSweeps * 100 * kQueueMs; t += period)
      messages.push_back({t, t + delay, -1, makeInput(source, t - period, t)});
  };
  add(MotionSource::Gyroscope, 10 * kQueueMs);
  add(MotionSource::Wheels, 40 * kQueueMs);
  for (int i = 0; i < kSweeps; ++i)
    messages.push_back(
        {(100 * i + 95) * kQueueMs, (100 * i + 95) * kQueueMs + static_cast<StampNs>(2 * kQueueMs), i, {}});
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.arrival < b.arrival; });
  return messages;
}

Queue::Options makeOptions(DeliveryOrder delivery) {
  Queue::Options options;
  options.max_lateness = 100 * kQueueMs;
  options.delivery = delivery;
  options.motion.gyroscope = options.motion.wheels = true;
  return options;
}

void put(const Message& message, Queue& queue) {
  if (message.sweep < 0) queue.add(message.motion);
  else queue.add(message.stamp, message.sweep);
}

void drain(Queue& queue, std::vector<Queue::Ready>& ready) {
  while (auto next = queue.take()) ready.push_back(std::move(*next));
}

std::vector<Queue::Ready> play(const std::vector<Message>& messages, DeliveryOrder delivery) {
  Queue queue(makeOptions(delivery));
  std::vector<Queue::Ready> ready;
  for (const Message& message : messages) {
    put(message, queue);
    drain(queue, ready);
  }
  queue.finish();
  drain(queue, ready);
  EXPECT_EQ(queue.late(), 0);
  return ready;
}

void expectSame(const std::vector<Queue::Ready>& a, const std::vector<Queue::Ready>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].sweep, b[i].sweep);
    ASSERT_EQ(a[i].inputs.size(), b[i].inputs.size()) << i;
    for (std::size_t k = 0; k < a[i].inputs.size(); ++k) EXPECT_TRUE(isApprox(a[i].inputs[k], b[i].inputs[k], 0.0));
  }
}

TEST(SweepMotionQueue, EachSweepHasTheInputsUpToItsEnd) {
  const std::vector<Queue::Ready> ready = play(makeMessages(0.0, 1), DeliveryOrder::OrderedStreams);
  ASSERT_EQ(ready.size(), static_cast<std::size_t>(kSweeps));
  for (int i = 0; i < kSweeps; ++i) {
    const Queue::Ready& sweep = ready[static_cast<std::size_t>(i)];
    EXPECT_EQ(sweep.sweep, i);
    const StampNs end = (100 * i + 95) * kQueueMs;
    for (const MotionInput& input : sweep.inputs) {
      EXPECT_LE(input.to, end);
      EXPECT_GT(input.to, end - 100 * kQueueMs);
    }
    EXPECT_GE(sweep.inputs.size(), 9U + 2U);
  }
}

TEST(SweepMotionQueue, LateInputsGiveTheSameSequenceLiveAndOffline) {
  const std::vector<Queue::Ready> expected = play(makeMessages(0.0, 1), DeliveryOrder::OrderedStreams);
  for (const std::uint64_t seed : {2, 3, 4}) {
    expectSame(play(makeMessages(50.0, seed), DeliveryOrder::OrderedStreams), expected);
    expectSame(play(makeMessages(50.0, seed), DeliveryOrder::Shuffled), expected);
  }
}

TEST(SweepMotionQueue, AbsentSensorsDelaySweepsByOneAtMost) {
  Queue queue(makeOptions(DeliveryOrder::OrderedStreams));
  std::vector<Queue::Ready> ready;
  for (int i = 0; i < kSweeps; ++i) {
    queue.add(100 * i * kQueueMs, i);
    drain(queue, ready);
    EXPECT_GE(ready.size() + 1, static_cast<std::size_t>(i) + 1);
  }
  EXPECT_EQ(ready.size(), static_cast<std::size_t>(kSweeps)) << "silent sensors are not waited for";
}

TEST(SweepMotionQueue, WithoutSensorsSweepsPassThrough) {
  Queue queue({});
  queue.add(makeInput(MotionSource::Wheels, 0, kQueueMs));
  for (int i = 0; i < 3; ++i) {
    queue.add(1000 - 400 * i, i);  // also with stamps that go back
    const auto ready = queue.take();
    ASSERT_TRUE(ready);
    EXPECT_EQ(ready->sweep, i);
    EXPECT_TRUE(ready->inputs.empty());
  }
}

TEST(SweepMotionQueue, GoesOnFromItsState) {
  const std::vector<Message> messages = makeMessages(50.0, 5);
  const std::vector<Queue::Ready> expected = play(messages, DeliveryOrder::Shuffled);
  const auto archiveNumber = [](Archive& archive, int& number) { archive(number); };
  for (const std::size_t half : {messages.size() / 2, messages.size() / 3}) {
    std::vector<Queue::Ready> ready;
    Queue first(makeOptions(DeliveryOrder::Shuffled)), second(makeOptions(DeliveryOrder::Shuffled));
    for (std::size_t i = 0; i < half; ++i) {
      put(messages[i], first);
      drain(first, ready);
    }
    Archive writer;
    first.archive(writer, archiveNumber);
    const std::string state = writer.take();
    Archive reader(state, "state");
    second.archive(reader, archiveNumber);
    reader.finish();
    for (std::size_t i = half; i < messages.size(); ++i) {
      put(messages[i], second);
      drain(second, ready);
    }
    second.finish();
    drain(second, ready);
    expectSame(ready, expected);
  }
}

}  // namespace
}  // namespace urban_nav_core
