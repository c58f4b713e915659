// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/stage_states.hpp"

#include <gtest/gtest.h>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::Folder;

TEST(States, OfAnyLengthComeBack) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  Drawn drawn(1);
  const std::string small = drawn.bytes(10), large = drawn.bytes(3'500'000), exact = std::string(2 << 20, 'x');
  {
    Store store(path, Access::Write);
    store.states().put("s", "small", large);
    store.states().put("s", "small", small);
    store.states().put("s", "large", large);
    store.states().put("s", "exact", exact);
    store.states().put("s", "empty", "");
    store.states().put("t", "large", small);
    store.commit();
  }
  Store store(path, Access::Read);
  EXPECT_EQ(store.states().get("s", "small"), small);
  EXPECT_TRUE(store.states().get("s", "large") == large);
  EXPECT_TRUE(store.states().get("s", "exact") == exact);
  EXPECT_EQ(store.states().get("s", "empty"), "");
  EXPECT_EQ(store.states().get("t", "large"), small);
  EXPECT_FALSE(store.states().get("t", "small"));
  EXPECT_EQ(store.states().stages("s"), (std::vector<std::string>{"empty", "exact", "large", "small"}));
  EXPECT_GT(store.states().bytes("s"), 3'500'000) << "random bytes cannot be compressed";
  EXPECT_LT(store.states().bytes("t"), 100);
  EXPECT_EQ(store.states().bytes("u"), 0);
  store.close();
  Store writer(path, Access::Write);
  writer.states().remove("s", "large");
  EXPECT_FALSE(writer.states().get("s", "large"));
}

}  // namespace
}  // namespace urban_nav_store
