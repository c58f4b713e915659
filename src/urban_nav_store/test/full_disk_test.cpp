// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_core/testing/small_disk.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::catchError;
using testing::expectError;
using testing::fill;
using testing::Folder;
using urban_nav_core::testing::SmallDisk;

TEST(FullDisk, IsNamedAndLosesNothingThatWasCommitted) {
  const Folder folder;
  for (const std::size_t room : {300'000U, 500'000U, 1'000'000U}) {
    const std::string path = folder.file(std::to_string(room) + ".db");
    Store store(path, Access::Write);
    std::string committed = dump(store), error;
    {
      const SmallDisk disk(room);
      for (std::uint32_t seed = 1; error.empty() && seed < 200; ++seed) {
        error = catchError([&] {
          fill(store, seed, 20);
          store.commit();
          committed = dump(store);
        });
      }
      EXPECT_NE(error.find("the disk is full; what was committed before is safe"), std::string::npos) << error;
      store.rollback();
      EXPECT_TRUE(dump(store) == committed);
    }
    fill(store, 1000, 20);  // space is available again
    store.commit();
    committed = dump(store);
    store.close();
    Store again(path, Access::Read);
    EXPECT_TRUE(dump(again) == committed);
  }
}

TEST(FullDisk, AnErrorLeavesTheStoreReadableForOthers) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  Store store(path, Access::Write);
  fill(store, 1, 20);
  store.commit();
  const std::string committed = dump(store);
  const SmallDisk disk(200'000);
  EXPECT_NE(catchError([&] {
              for (std::uint32_t seed = 2; seed < 100; ++seed) fill(store, seed, 20);
              store.commit();
            }),
            "");
  Store reader(path, Access::Read);
  EXPECT_TRUE(dump(reader) == committed);
}

TEST(FullDisk, MakesNoHalfStore) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  {
    const SmallDisk disk(10'000);
    expectError([&] { Store(path, Access::Write); }, path, "disk is full");
  }
  EXPECT_EQ(folder.files(), 0U);
  {
    Store store(path, Access::Write);
    fill(store, 1, 100);
    store.commit();
  }
  const SmallDisk disk(100'000);
  expectError([&] { merge({path}, folder.file("merged.db")); }, folder.file("merged.db"), "disk is full");
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
}  // namespace urban_nav_store
