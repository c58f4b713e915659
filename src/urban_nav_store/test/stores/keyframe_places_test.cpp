// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/folder.hpp"
#include "support/older_store.hpp"
#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"

namespace urban_nav_store {
namespace {

StoredKeyframePlace makeRow() {
  StoredKeyframePlace row;
  row.session = "s";
  row.stamp = 7;
  row.status = "used";
  row.model = "0123456789abcdef";
  row.words = std::string("\1\0\2", 3);
  row.descriptors = "descriptors";
  return row;
}

class StoredKeyframePlaces : public ::testing::Test {
 protected:
  void write() const {
    Store store(path, Access::Write);
    store.sessions().put(Session{"s", "quad", "", "", 1, true});
    TableStore<StoredKeyframePlace>(store).put(makeRow());
    store.commit();
  }
  const testing::Folder folder;
  const std::string path = folder.file("s.db");
};

TEST_F(StoredKeyframePlaces, AreApartFromPlacesAtTheSameTimeAndStayWhenResultsAreCleared) {
  write();
  Store store(path, Access::Write);
  store.sessions().clear("s");
  const auto found = TableStore<StoredKeyframePlace>(store).get(makeRow());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->words, makeRow().words);
  EXPECT_EQ(found->descriptors, makeRow().descriptors);
  EXPECT_FALSE(TableStore<StoredPlace>(store).get(makeRow()));
}

TEST_F(StoredKeyframePlaces, AreMergedWithTheirSession) {
  write();
  merge({path}, folder.file("merged.db"));
  Store merged(folder.file("merged.db"), Access::Read);
  EXPECT_TRUE(TableStore<StoredKeyframePlace>(merged).get(makeRow()));
}

TEST_F(StoredKeyframePlaces, AreAddedToAStoreOfSchema4) {
  {
    Store store(path, Access::Write);
    store.sessions().put(Session{"s", "quad", "", "", 1, true});
    store.commit();
  }
  testing::makeOlder(path, folder, 4);
  {
    Store store(path, Access::Read);
    EXPECT_FALSE(TableStore<StoredKeyframePlace>(store).get(makeRow())) << "as in a map of an earlier version";
  }
  Store store(path, Access::Write);
  TableStore<StoredKeyframePlace>(store).put(makeRow());
  EXPECT_TRUE(TableStore<StoredKeyframePlace>(store).get(makeRow()));
}

}  // namespace
}  // namespace urban_nav_store
