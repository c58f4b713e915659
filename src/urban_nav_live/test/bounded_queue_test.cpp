// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace urban_nav_live {
namespace {

constexpr std::chrono::milliseconds kNoWait{0}, kLongWait{10000};

TEST(BoundedQueue, ReturnsAllItemsOldestFirst) {
  BoundedQueue<int> queue(5);
  for (int i = 0; i < 3; ++i) queue.push(i);
  EXPECT_EQ(queue.takeAll(kNoWait), (std::deque<int>{0, 1, 2}));
  EXPECT_TRUE(queue.takeAll(kNoWait).empty());
}

TEST(BoundedQueue, DropsTheOldestAndCounts) {
  BoundedQueue<int> queue;
  queue.setCapacity(2);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(queue.dropped(), 3);
  EXPECT_EQ(queue.takeAll(kNoWait), (std::deque<int>{3, 4}));
}

TEST(BoundedQueue, AnItemEndsAWait) {
  BoundedQueue<std::unique_ptr<int>> queue;
  std::thread writer([&queue] { queue.push(std::make_unique<int>(7)); });
  const auto items = queue.takeAll(kLongWait);
  writer.join();
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(*items[0], 7);
}

TEST(BoundedQueue, WakeEndsAWaitWithoutAnItem) {
  BoundedQueue<int> queue(2);
  queue.wake();
  EXPECT_TRUE(queue.takeAll(kLongWait).empty());
  std::thread waker([&queue] { queue.wake(); });
  EXPECT_TRUE(queue.takeAll(kLongWait).empty());
  waker.join();
  queue.push(1);
  EXPECT_EQ(queue.takeAll(kLongWait).size(), 1U);
}

TEST(BoundedQueue, CloseEndsAWaitAndIgnoresLaterItems) {
  BoundedQueue<int> queue;
  std::thread closer([&queue] { queue.close(); });
  EXPECT_TRUE(queue.takeAll(kLongWait).empty());
  closer.join();
  EXPECT_TRUE(queue.isClosed());
  queue.push(1);
  EXPECT_TRUE(queue.takeAll(kNoWait).empty());
}

}  // namespace
}  // namespace urban_nav_live
