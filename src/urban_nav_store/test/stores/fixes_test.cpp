// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/folder.hpp"
#include "support/older_store.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_fix.hpp"

namespace urban_nav_store {
namespace {

const StoredFix kFix{"s", 7, 51.7548, -1.2544, 110.25, 2.0, 2.5, 4.0, 0.1, -0.2, 1.4};

class StoredFixes : public ::testing::Test {
 protected:
  const testing::Folder folder;
  const std::string path = folder.file("s.db");
};

TEST_F(StoredFixes, ComeBackBitByBitAndStayWhenResultsAreCleared) {
  Store store(path, Access::Write);
  store.sessions().put(Session{"s", "quad", "", "", 1, true});
  TableStore<StoredFix> fixes(store);
  fixes.put(kFix);
  store.sessions().clear("s");
  const auto found = fixes.get({"s", 7});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->latitude, kFix.latitude);
  EXPECT_EQ(found->longitude, kFix.longitude);
  EXPECT_EQ(found->height, kFix.height);
  EXPECT_EQ(found->sigma_north, kFix.sigma_north);
  EXPECT_EQ(found->z, kFix.z);
}

TEST_F(StoredFixes, AStoreOfSchema3GetsTheTable) {
  {
    Store store(path, Access::Write);
    store.sessions().put(Session{"s", "quad", "", "", 1, true});
    store.commit();
  }
  testing::makeOlder(path, folder, 3);
  {
    Store store(path, Access::Read);
    EXPECT_EQ(store.sessions().all().size(), 1U);
  }
  Store store(path, Access::Write);
  TableStore<StoredFix>(store).put(kFix);
  EXPECT_TRUE(TableStore<StoredFix>(store).get({"s", 7}));
}

}  // namespace
}  // namespace urban_nav_store
