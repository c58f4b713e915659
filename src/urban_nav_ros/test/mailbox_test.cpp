// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/mailbox.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace urban_nav_ros {
namespace {

constexpr std::chrono::milliseconds no_patience{0}, long_patience{10000};

TEST(Mailbox, HandsOverAllThereIsOldestFirst) {
  Mailbox<int> box;
  box.setCapacity(5);
  for (int i = 0; i < 3; ++i) box.put(i);
  EXPECT_EQ(box.takeAll(no_patience), (std::deque<int>{0, 1, 2}));
  EXPECT_TRUE(box.takeAll(no_patience).empty());
}

TEST(Mailbox, DropsTheOldestAndCounts) {
  Mailbox<int> box;
  box.setCapacity(2);
  for (int i = 0; i < 5; ++i) box.put(i);
  EXPECT_EQ(box.dropped(), 3);
  EXPECT_EQ(box.takeAll(no_patience), (std::deque<int>{3, 4}));
}

TEST(Mailbox, WakesWhoWaits) {
  Mailbox<std::unique_ptr<int>> box;
  std::thread writer([&box] { box.put(std::make_unique<int>(7)); });
  const auto items = box.takeAll(long_patience);
  writer.join();
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(*items[0], 7);
}

TEST(Mailbox, IsWokenWithoutAnItem) {
  Mailbox<int> box;
  box.setCapacity(2);
  box.wake();
  EXPECT_TRUE(box.takeAll(long_patience).empty());
  std::thread waker([&box] { box.wake(); });
  EXPECT_TRUE(box.takeAll(long_patience).empty());
  waker.join();
  box.put(1);
  EXPECT_EQ(box.takeAll(long_patience).size(), 1U);
}

TEST(Mailbox, ClosedItWakesTheWorkerAndTakesNothingMore) {
  Mailbox<int> box;
  std::thread closer([&box] { box.close(); });
  EXPECT_TRUE(box.takeAll(long_patience).empty());
  closer.join();
  EXPECT_TRUE(box.closed());
  box.put(1);
  EXPECT_TRUE(box.takeAll(no_patience).empty());
}

}  // namespace
}  // namespace urban_nav_ros
