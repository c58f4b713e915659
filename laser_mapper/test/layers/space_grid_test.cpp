// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/space_grid.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "laser_mapper/layers/octomap_file.hpp"

#ifdef URBAN_NAV_OCTOMAP
#include <octomap/OcTree.h>
#endif

namespace laser_mapper {
namespace {

using Eigen::Vector3d;

constexpr double kEdge = 0.1;  // m

/// A wall at x = 5, two metres wide and high, seen from a laser at (-0.33, 0.12, 0.97).
class SpaceGridTest : public ::testing::Test {
 protected:
  const Vector3d laser_{-0.33, 0.12, 0.97};

  SpaceGridTest() : space_(kEdge) {
    std::vector<MapPoint> points;
    for (double y = -0.975; y < 1.0; y += 0.05)
      for (double z = 0.025; z < 2.0; z += 0.05) {
        MapPoint point;
        point.p = Vector3d(5.02, y, z).cast<float>();
        points.push_back(point);
      }
    space_.add(points, [&](const MapPoint&) { return laser_; });
  }
  SpaceGrid space_;
};

TEST_F(SpaceGridTest, IsOccupiedAtTheWallFreeBeforeItAndUnknownBeyondIt) {
  for (double y = -0.95; y < 1.0; y += 0.1)
    for (double z = 0.05; z < 2.0; z += 0.1) {
      ASSERT_EQ(space_.at({5.05, y, z}), SpaceState::Occupied) << y << " " << z;
      ASSERT_EQ(space_.at({5.15, y, z}), SpaceState::Unknown) << y << " " << z;
    }
  for (double part = 0.01; part < 0.97; part += 0.013)
    for (const Vector3d& end : {Vector3d(5.02, -0.925, 0.075), Vector3d(5.02, 0.525, 1.925)})
      EXPECT_EQ(space_.at(laser_ + part * (end - laser_)), SpaceState::Free) << part;
  EXPECT_EQ(space_.at({-1.0, 0.0, 1.0}), SpaceState::Unknown) << "at the back of the laser";
  EXPECT_EQ(space_.at({0.0, 1.5, 1.0}), SpaceState::Unknown) << "outside the beams";
}

TEST_F(SpaceGridTest, BeamsDoNotFreeWhatPointsOccupy) {
  MapPoint point;
  point.p = {8.0F, 0.02F, 1.0F};  // seen through the wall
  space_.add({point}, [&](const MapPoint&) { return laser_; });
  EXPECT_EQ(space_.at({5.05, 0.05, 0.99}), SpaceState::Occupied);
  EXPECT_EQ(space_.at({6.5, 0.05, 0.99}), SpaceState::Free);
}

TEST(SpaceGrid, PointsWithoutABeamFreeNothing) {
  SpaceGrid space(kEdge);
  MapPoint point;
  point.p = {2.0F, 3.0F, -4.0F};
  space.add({point}, [](const MapPoint&) { return std::nullopt; });
  EXPECT_EQ(space.blocks().size(), 1U);
  EXPECT_EQ(space.at({2.01, 3.01, -3.99}), SpaceState::Occupied);
}

TEST(OctomapFile, OneCubeIsOneBranchOfTheTree) {
  SpaceGrid space(kEdge);
  MapPoint point;
  point.p = {0.05F, 0.05F, 0.05F};
  space.add({point}, [](const MapPoint&) { return std::nullopt; });
  const OctomapText text = printOctomap(space);
  const std::string head = "# Octomap OcTree binary file\n";
  EXPECT_EQ(text.bytes.substr(0, head.size()), head);
  EXPECT_NE(text.bytes.find("\nid OcTree\nsize 17\nres 0.1\ndata\n"), std::string::npos) << "the root and 16 levels";
  const std::string nodes = text.bytes.substr(text.bytes.find("data\n") + 5);
  ASSERT_EQ(nodes.size(), 32U);
  EXPECT_EQ(nodes.substr(0, 2), std::string("\0\xc0", 2)) << "the last of the eight children is divided";
  for (std::size_t level = 1; level < 15; ++level)
    EXPECT_EQ(nodes.substr(2 * level, 2), std::string("\3\0", 2)) << "the first one";
  EXPECT_EQ(nodes.substr(30), std::string("\2\0", 2)) << "occupied";
  EXPECT_EQ(text.occupied, 1U);
  EXPECT_EQ(text.free, 0U);
}

TEST(OctomapFile, AnEmptyMapIsAnEmptyTree) {
  EXPECT_NE(printOctomap(SpaceGrid(0.2)).bytes.find("\nsize 0\nres 0.2\ndata\n"), std::string::npos);
}

TEST_F(SpaceGridTest, OctomapReadsEveryCubeBack) {
#ifdef URBAN_NAV_OCTOMAP
  std::stringstream file(printOctomap(space_).bytes);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(file));
  EXPECT_EQ(tree.getResolution(), kEdge);
  EXPECT_EQ(tree.size(), printOctomap(space_).nodes);
  std::size_t known = 0;
  for (double x = -0.95; x < 6.0; x += kEdge)
    for (double y = -1.45; y < 1.5; y += kEdge)
      for (double z = -0.45; z < 2.5; z += kEdge) {
        const octomap::OcTreeNode* node = tree.search(x, y, z);
        const SpaceState expected = space_.at({x, y, z});
        ASSERT_EQ(node != nullptr, expected != SpaceState::Unknown) << x << " " << y << " " << z;
        if (node == nullptr) continue;
        ASSERT_EQ(tree.isNodeOccupied(node), expected == SpaceState::Occupied) << x << " " << y << " " << z;
        ++known;
      }
  EXPECT_GT(known, 3000U);
#else
  GTEST_SKIP() << "liboctomap-dev is not installed";
#endif
}

}  // namespace
}  // namespace laser_mapper
