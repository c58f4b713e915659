// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/input_order.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/folder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Folder;

std::vector<InputEvent> all(Store& store, const SessionId& session) {
  std::vector<InputEvent> events;
  store.inputs().forEach(session, [&](const InputEvent& event) { events.push_back(event); });
  return events;
}

TEST(Inputs, KeepTheirOrderOverBlocksCommitsAndOpenings) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  std::vector<InputEvent> events;
  for (int i = 0; i < 10'000; ++i) events.push_back({i % 2 == 0 ? "stereo" : "imu", 1000LL * (i % 77), i % 3 == 0});
  std::size_t next = 0;
  for (const std::size_t until : {1UL, 4095UL, 4096UL, 4097UL, 9000UL, events.size()}) {
    Store store(path, Access::Write);
    for (; next < until; ++next) store.inputs().append("s", events[next]);
    store.inputs().append("other", events[next - 1]);
    store.commit();
    store.inputs().append("s", events[0]);
    store.rollback();
  }
  Store store(path, Access::Read);
  EXPECT_EQ(all(store, "s"), events);
  EXPECT_EQ(all(store, "other").size(), 6U);
  EXPECT_TRUE(all(store, "none").empty());
}

}  // namespace
}  // namespace urban_nav_store
