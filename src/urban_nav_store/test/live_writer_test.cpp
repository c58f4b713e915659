// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/live_writer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_core/testing/small_disk.hpp"
#include "urban_nav_store/dump.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::fill;
using testing::Folder;
using urban_nav_core::testing::SmallDisk;

constexpr std::chrono::milliseconds kNever{100'000'000};

LiveWriter::Write nodeAt(urban_nav_core::StampNs stamp) {
  return [stamp](Store& store) {
    Drawn drawn(static_cast<std::uint32_t>(stamp));
    store.graph().put("live", drawn.node(stamp));
  };
}

TEST(LiveWriter, CommitsWhatWasPostedInItsOrder) {
  const Folder folder;
  Store expected(folder.file("expected.db"), Access::Write);
  {
    LiveWriter writer(Store(folder.file("s.db"), Access::Write), {1000, std::chrono::milliseconds(1)});
    for (int i = 0; i < 500; ++i) {
      // Two writes with the same stamp: the later one is kept.
      EXPECT_TRUE(writer.post(nodeAt(i)));
      EXPECT_TRUE(writer.post([i](Store& store) { store.inputs().append("live", {"stereo", i, true}); }));
      nodeAt(i)(expected);
      expected.inputs().append("live", {"stereo", i, true});
      if (i % 100 == 0) writer.flush();
    }
    writer.flush();
    const LiveWriter::Counts counts = writer.counts();
    EXPECT_EQ(counts.committed, 1000);
    EXPECT_EQ(counts.waiting, 0U);
    EXPECT_EQ(counts.fault, "");
    Store reader(folder.file("s.db"), Access::Read);
    EXPECT_TRUE(dump(reader) == dump(expected)) << "while it is writing";
  }
}

TEST(LiveWriter, CommitsWhenItEnds) {
  const Folder folder;
  {
    LiveWriter writer(Store(folder.file("s.db"), Access::Write), {1000, kNever});
    for (int i = 0; i < 10; ++i) writer.post(nodeAt(i));
  }
  EXPECT_EQ(Store(folder.file("s.db"), Access::Read).graph().nodes("live"), 10);
}

TEST(LiveWriter, DropsAndCountsWhatHasNoRoom) {
  const Folder folder;
  LiveWriter writer(Store(folder.file("s.db"), Access::Write), {5, kNever});
  for (int i = 0; i < 8; ++i) EXPECT_EQ(writer.post(nodeAt(i)), i < 5);
  EXPECT_EQ(writer.counts().dropped, 3);
  writer.flush();
  EXPECT_EQ(writer.counts().committed, 5);
  EXPECT_TRUE(writer.post(nodeAt(9)));
}

TEST(LiveWriter, OneRefusedWriteCostsNoOther) {
  const Folder folder;
  {
    LiveWriter writer(Store(folder.file("s.db"), Access::Write), {1000, kNever});
    for (int i = 0; i < 10; ++i) writer.post(nodeAt(i));
    writer.post([](Store& store) {
      nodeAt(100)(store);
      Node bad;
      bad.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
      store.graph().put("live", bad);
    });
    for (int i = 10; i < 20; ++i) writer.post(nodeAt(i));
    writer.flush();
    EXPECT_EQ(writer.counts().refused, 1);
    EXPECT_EQ(writer.counts().committed, 20);
    EXPECT_NE(writer.counts().fault.find("not finite"), std::string::npos);
  }
  Store store(folder.file("s.db"), Access::Read);
  EXPECT_EQ(store.graph().nodes("live"), 20);
  EXPECT_FALSE(store.graph().node({"live", 100})) << "the first half of the refused one";
}

TEST(LiveWriter, AFullDiskDelaysAndLosesNothing) {
  const Folder folder;
  LiveWriter writer(Store(folder.file("s.db"), Access::Write), {5000, kNever});
  {
    const SmallDisk disk(200'000);
    for (int i = 0; i < 2000; ++i) writer.post(nodeAt(i));
    writer.flush();
    EXPECT_NE(writer.counts().fault.find("disk is full"), std::string::npos) << writer.counts().fault;
    EXPECT_EQ(writer.counts().waiting, 2000U);
    EXPECT_TRUE(writer.post(nodeAt(2000)));
  }
  writer.flush();
  EXPECT_EQ(writer.counts().fault, "");
  EXPECT_EQ(writer.counts().committed, 2001);
  Store reader(folder.file("s.db"), Access::Read);
  EXPECT_EQ(reader.graph().nodes("live"), 2001);
}

TEST(LiveWriter, TakesFromManyThreads) {
  const Folder folder;
  {
    LiveWriter writer(Store(folder.file("s.db"), Access::Write), {10000, std::chrono::milliseconds(1)});
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 100; ++i) writer.post(nodeAt(1000 * t + i));
        writer.flush();
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(writer.counts().committed, 400);
  }
  EXPECT_EQ(Store(folder.file("s.db"), Access::Read).graph().nodes("live"), 400);
}

}  // namespace
}  // namespace urban_nav_store
