// SPDX-License-Identifier: BSD-3-Clause
#include "live/pose_revisions.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

using Ranges = std::vector<PoseRevisions::Range>;

TEST(PoseRevisions, ReturnsRangesMovedSinceARevision) {
  PoseRevisions log;
  log.grow(10, 0);
  EXPECT_EQ(log.movedSince(-1, 0, 10), (Ranges{{0, 9}}));
  EXPECT_EQ(log.movedSince(0, 0, 10), (Ranges{{0, 9}})) << "all have come since";
  EXPECT_EQ(log.movedSince(1, 0, 10), Ranges());
  log.setMoved({3, 5}, 2);
  log.setMoved({8, 8}, 2);
  EXPECT_EQ(log.movedSince(1, 0, 10), (Ranges{{3, 5}, {8, 8}}));
  EXPECT_EQ(log.movedSince(2, 0, 10), Ranges());
  log.grow(12, 2);
  EXPECT_EQ(log.movedSince(2, 0, 12), (Ranges{{10, 11}}));
}

TEST(PoseRevisions, KeepsToTheBounds) {
  PoseRevisions log;
  log.grow(10, 0);
  EXPECT_EQ(log.movedSince(0, 4, 6), (Ranges{{4, 5}}));
  EXPECT_EQ(log.movedSince(0, 4, 100), (Ranges{{4, 9}}));
  EXPECT_EQ(log.movedSince(0, 20, 30), Ranges());
  log.setMoved({5, 100}, 3);
  EXPECT_EQ(log.movedSince(2, 0, 10), (Ranges{{5, 9}}));
}

}  // namespace
}  // namespace pose_graph
