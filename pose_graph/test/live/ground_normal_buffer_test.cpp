// SPDX-License-Identifier: BSD-3-Clause
#include "live/ground_normal_buffer.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

constexpr StampNs kFrame = 50'000'000;

/// Returns a straight drive with `spacing` metres between poses.
Track makeTrack(int poses, double spacing) {
  Track track;
  for (int i = 0; i < poses; ++i) {
    track.stamps.push_back(i * kFrame);
    track.odom.emplace_back(Eigen::Quaterniond::Identity(), Eigen::Vector3d(spacing * i, 0.0, 0.0));
  }
  return track;
}

void addNormals(int first, int end, GroundNormalBuffer& buffer) {
  for (int i = first; i < end; ++i) buffer.add({i * kFrame, Eigen::Vector3d::UnitZ(), 1e-3});
}

TEST(GroundNormalBuffer, KeepsWhatIsAheadOfThePoses) {
  GroundNormalBuffer buffer;
  addNormals(0, 10, buffer);
  EXPECT_TRUE(buffer.takeAt(Track()).empty());
  EXPECT_EQ(buffer.takeAt(makeTrack(4, 1.0)).size(), 4u);
  EXPECT_TRUE(buffer.takeAt(makeTrack(4, 1.0)).empty());
  const std::vector<GroundNormal> rest = buffer.takeAt(makeTrack(20, 1.0));
  ASSERT_EQ(rest.size(), 6u);
  EXPECT_EQ(rest.front().stamp, 4 * kFrame);
  EXPECT_EQ(rest.back().stamp, 9 * kFrame);
}

TEST(GroundNormalBuffer, TakesOneEveryQuarterMetreAndOneAtRest) {
  GroundNormalBuffer moving, standing;
  addNormals(0, 101, moving);
  addNormals(0, 101, standing);
  EXPECT_EQ(moving.takeAt(makeTrack(101, 0.125)).size(), 51u);
  EXPECT_EQ(standing.takeAt(makeTrack(101, 0.0)).size(), 1u);
}

TEST(GroundNormalBuffer, DropsStampsWithoutAPoseAndThoseThatAreLate) {
  GroundNormalBuffer buffer;
  buffer.add({kFrame / 2, Eigen::Vector3d::UnitZ(), 1e-3});
  addNormals(3, 4, buffer);
  addNormals(1, 2, buffer);
  const std::vector<GroundNormal> taken = buffer.takeAt(makeTrack(10, 1.0));
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].stamp, 3 * kFrame);
}

TEST(GroundNormalBuffer, ASessionBeginsWithoutTheStampsOfTheLastOne) {
  GroundNormalBuffer buffer;
  addNormals(0, 10, buffer);
  buffer.takeAt(makeTrack(10, 1.0));
  buffer.beginSession();
  addNormals(0, 3, buffer);
  EXPECT_EQ(buffer.takeAt(makeTrack(10, 1.0)).size(), 3u);
}

}  // namespace
}  // namespace pose_graph
