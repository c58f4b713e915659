// SPDX-License-Identifier: BSD-3-Clause
#include "stage_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "urban_nav_core/testing/small_disk.hpp"

namespace loop_metric::test {
namespace {

using urban_nav_store::Access;
using urban_nav_store::Session;
using urban_nav_store::Store;

TEST(StageStore, withoutAPathItIsATemporaryFileThatGoes) {
  std::string path;
  {
    StageStore store("");
    EXPECT_FALSE(store.isOpen());
    store.post([](Store&) {});
    EXPECT_EQ(store.state().lost, 1) << "nowhere to put it yet";
    EXPECT_TRUE(store.open());
    EXPECT_FALSE(store.open()) << "said once";
    store.post([](Store& each) { each.sessions().put(Session{"0123456789abcdef0123", "a", "", "", 1, false}); });
    store.flush();
    path = store.state().path;
    EXPECT_EQ(store.state().fault, "");
    EXPECT_EQ(Store(path, Access::Read).sessions().all().size(), 1U);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(path).parent_path()));
}

TEST(StageStore, aPathThatCannotBeIsNamedAndNothingIsLostInSilence) {
  for (const char* path : {"relative.db", "/proc/no/such/folder/session.db"}) {
    StageStore store(path);
    EXPECT_FALSE(store.open());
    EXPECT_FALSE(store.isOpen());
    EXPECT_NE(store.state().fault.find(path), std::string::npos) << store.state().fault;
    store.post([](Store&) {});
    EXPECT_EQ(store.state().lost, 1);
    store.flush();
  }
}

TEST(StageStore, onAFullDiskWritesWaitAndWhatHasNoRoomIsCounted) {
  StageStore store("");
  ASSERT_TRUE(store.open());
  const auto write = [](Store& each) {
    each.sessions().put(Session{"0123456789abcdef0123", std::string(500'000, 'a'), "", "", 1, false});
  };
  std::int64_t posted = 1;
  {
    const urban_nav_core::testing::SmallDisk disk(100'000);
    store.post(write);
    store.flush();
    EXPECT_NE(store.state().fault.find("the disk is full"), std::string::npos) << store.state().fault;
    EXPECT_EQ(store.state().committed, 0);
    EXPECT_EQ(store.state().waiting, 1U);
    for (; store.state().lost < 3; ++posted) {
      store.post([](Store&) {});
      ASSERT_LT(posted, 100'000) << "some room, and not more";
    }
    EXPECT_EQ(store.state().waiting, static_cast<std::size_t>(posted - 3));
  }
  store.flush();
  EXPECT_EQ(store.state().fault, "");
  EXPECT_EQ(store.state().committed, posted - 3) << "what waited is not lost";
  EXPECT_EQ(store.state().lost, 3);
  EXPECT_EQ(Store(store.state().path, Access::Read).sessions().all().size(), 1U);
}

TEST(StageStore, oneWriterAFile) {
  const std::string path = ::testing::TempDir() + "loop_metric_stage_store.db";
  urban_nav_store::removeStore(path);
  {
    Store other(path, Access::Write);
    StageStore store(path);
    EXPECT_FALSE(store.open());
    EXPECT_NE(store.state().fault, "");
  }
  urban_nav_store::removeStore(path);
}

}  // namespace
}  // namespace loop_metric::test
