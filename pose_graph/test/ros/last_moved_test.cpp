// SPDX-License-Identifier: BSD-3-Clause
#include "last_moved.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

using Ranges = std::vector<LastMoved::Range>;

TEST(LastMoved, TellsWhatIsNewSinceARevision) {
  LastMoved log;
  log.grow(10, 0);
  EXPECT_EQ(log.since(-1, 0, 10), (Ranges{{0, 9}}));
  EXPECT_EQ(log.since(0, 0, 10), (Ranges{{0, 9}})) << "all have come since";
  EXPECT_EQ(log.since(1, 0, 10), Ranges());
  log.moved({3, 5}, 2);
  log.moved({8, 8}, 2);
  EXPECT_EQ(log.since(1, 0, 10), (Ranges{{3, 5}, {8, 8}}));
  EXPECT_EQ(log.since(2, 0, 10), Ranges());
  log.grow(12, 2);
  EXPECT_EQ(log.since(2, 0, 12), (Ranges{{10, 11}}));
}

TEST(LastMoved, KeepsToTheBounds) {
  LastMoved log;
  log.grow(10, 0);
  EXPECT_EQ(log.since(0, 4, 6), (Ranges{{4, 5}}));
  EXPECT_EQ(log.since(0, 4, 100), (Ranges{{4, 9}}));
  EXPECT_EQ(log.since(0, 20, 30), Ranges());
  log.moved({5, 100}, 3);
  EXPECT_EQ(log.since(2, 0, 10), (Ranges{{5, 9}}));
}

}  // namespace
}  // namespace pose_graph
