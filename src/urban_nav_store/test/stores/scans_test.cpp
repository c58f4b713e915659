// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/scan_store.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::expectError;
using testing::Folder;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;

std::vector<StampNs> listStamps(Store& store, const std::string& laser, StampNs from, StampNs to) {
  std::vector<StampNs> stamps;
  store.scans().forEach("s", laser, from, to, [&](const Scan& scan) { stamps.push_back(scan.stamp); });
  return stamps;
}

TEST(Scans, ComeBackInOrderWhateverTheOrderTheyCameIn) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  std::vector<Scan> scans;
  Drawn drawn(1);
  for (int i = -100; i < 300; ++i) scans.push_back(drawn.scan(13'333'333LL * i, 20));  // before 1970 too
  {
    Store store(path, Access::Write);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      store.scans().put("s", "left", scans[i % 2 == 0 ? i : scans.size() - i]);
      store.scans().put("s", "right", scans[i]);
      if (i % 50 == 0) store.commit();
    }
    store.scans().put("s", "left", scans[7]);
    store.commit();
  }
  Store store(path, Access::Read);
  EXPECT_EQ(store.scans().lasers("s"), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(store.scans().count("s", "left"), 400);
  EXPECT_EQ(store.scans().count("s", "middle"), 0);
  for (const char* laser : {"left", "right"}) {
    std::size_t next = 0;
    store.scans().forEach("s", laser, scans.front().stamp, scans.back().stamp, [&](const Scan& scan) {
      ASSERT_LT(next, scans.size());
      EXPECT_TRUE(isApprox(scan, scans[next++], 0.0));
    });
    EXPECT_EQ(next, scans.size());
  }
  EXPECT_EQ(listStamps(store, "left", scans[120].stamp, scans[122].stamp),
            (std::vector<StampNs>{scans[120].stamp, scans[121].stamp, scans[122].stamp}));
  EXPECT_TRUE(listStamps(store, "middle", -1000, 1000).empty());
}

TEST(Scans, NoBeamThatIsNoneGetsIn) {
  const Folder folder;
  Store store(folder.file("s.db"), Access::Write);
  Drawn drawn(1);
  Scan scan = drawn.scan(5, 10);
  scan.beams[3].intensity = std::numeric_limits<float>::infinity();
  expectError([&] { store.scans().put("s", "left", scan); }, folder.file("s.db"), "has a beam that is not finite");
  EXPECT_TRUE(store.scans().lasers("s").empty());
}

TEST(Scans, WhatIsTakenBackIsNotThere) {
  const Folder folder;
  Store store(folder.file("s.db"), Access::Write);
  Drawn drawn(1);
  store.scans().put("s", "left", drawn.scan(5, 10));
  store.commit();
  store.scans().put("s", "left", drawn.scan(6, 10));
  store.rollback();
  store.scans().put("s", "left", drawn.scan(7, 10));
  store.commit();
  EXPECT_EQ(listStamps(store, "left", 0, 100), (std::vector<StampNs>{5, 7}));
}

}  // namespace
}  // namespace urban_nav_store
