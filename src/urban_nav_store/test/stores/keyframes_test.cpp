// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/keyframe_store.hpp"

#include <gtest/gtest.h>

#include "sqlite/connection.hpp"
#include "support/contents.hpp"
#include "support/folder.hpp"
#include "support/older_store.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::expectError;
using testing::Folder;
using urban_nav_core::StampNs;

TEST(Keyframes, ComeBackAsTheyWere) {
  const Folder folder;
  Drawn drawn(1);
  const StoredKeyframe first{-5, drawn.bytes(3000), drawn.bytes(700)},
      second{7'000'000'000, std::string("\0JPEG", 5), ""};
  {
    Store store(folder.file("s.db"), Access::Write);
    store.keyframes().put("s", "left", second);
    store.keyframes().put("s", "left", first);
    store.keyframes().put("s", "right", {7'000'000'000, "other", "camera"});
    store.keyframes().put("t", "left", {7'000'000'000, "other", "session"});
    store.keyframes().put("s", "left", first);
    store.commit();
  }
  Store store(folder.file("s.db"), Access::Read);
  EXPECT_EQ(store.keyframes().stamps("s", "left"), (std::vector<StampNs>{-5, 7'000'000'000}));
  EXPECT_EQ(store.keyframes().cameras("s"), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(store.keyframes().get("s", "left", -5), first);
  EXPECT_EQ(store.keyframes().get("s", "left", 7'000'000'000), second);
  EXPECT_FALSE(store.keyframes().get("s", "left", 0));
  EXPECT_FALSE(store.keyframes().get("u", "left", -5));
}

TEST(Keyframes, OutliveWhatStagesMadeOfTheirSession) {
  const Folder folder;
  Store store(folder.file("s.db"), Access::Write);
  const SessionId id = testing::fill(store, 1, 20);
  store.sessions().clear(id);
  EXPECT_FALSE(store.sessions().find(id));
  EXPECT_EQ(store.keyframes().stamps(id, "left").size(), 4U);
  EXPECT_EQ(store.scans().count(id, "laser_left"), 20);
  store.sessions().remove(id);
  EXPECT_TRUE(store.keyframes().cameras(id).empty());
  EXPECT_TRUE(store.scans().lasers(id).empty());
}

TEST(Keyframes, AStoreFromBeforeThemIsReadAsItIsAndGetsThemWhenItIsWritten) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  SessionId id;
  {
    Store store(path, Access::Write);
    id = testing::fill(store, 1, 3);
    store.commit();
  }
  testing::makeOlder(path, folder, 1);
  {
    Store store(path, Access::Read);
    EXPECT_TRUE(store.keyframes().cameras(id).empty());
    EXPECT_TRUE(store.keyframes().stamps(id, "left").empty());
    EXPECT_FALSE(store.keyframes().get(id, "left", 0));
    EXPECT_EQ(store.scans().count(id, "laser_left"), 3);
  }
  {
    Store store(path, Access::Write);
    store.keyframes().put(id, "left", {1, "image", "features"});
    store.commit();
    EXPECT_EQ(store.scans().count(id, "laser_left"), 3);
  }
  EXPECT_TRUE(Store(path, Access::Read).keyframes().get(id, "left", 1));
}

TEST(Keyframes, OneThatWasDamagedOrLostIsNamed) {
  const Folder folder;
  const auto broken = [&](const std::string& name, const std::string& sql) {
    const std::string path = folder.file(name);
    {
      Store store(path, Access::Write);
      store.keyframes().put("s", "left", {1, "image", "features"});
      store.keyframes().put("s", "left", {2, "image", "features"});
      store.commit();
    }
    Connection connection(path, Connection::Mode::Write);
    connection.execute(sql);
    connection.close();
    expectError([&] { Store(path, Access::Read).keyframes().get("s", "left", 1); }, path, "is damaged");
  };
  broken("changed.db", "UPDATE keyframe SET image='other' WHERE stamp_ns=1");
  broken("lost.db", "DROP TRIGGER keyframe_out; DELETE FROM keyframe WHERE stamp_ns=2");
}

}  // namespace
}  // namespace urban_nav_store
