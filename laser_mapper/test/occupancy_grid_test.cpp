// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laser_mapper {
namespace {

using urban_nav_core::Vector3d;

/// A drive along x over ground that rises across it by 15 %, with a wall, a kerb and an arch; nothing is measured
/// farther than y = 9.
class OccupancyGridTest : public ::testing::Test {
 protected:
  static double groundAt(double y) { return 0.15 * y; }

  OccupancyGridTest() {
    for (double x = 0.0; x <= 10.0; x += 0.1) path_.emplace_back(x, 0.0, 0.0);
    for (double x = 0.0; x <= 10.0; x += 0.05)
      for (double y = -3.0; y <= 8.0; y += 0.05) {
        if (y > 5.0 && y < 7.0) continue;  // nothing ends here, but beams pass
        const double kerb = x > 6.0 && y < -2.0 ? 0.15 : 0.0;
        add(x, y, groundAt(y) + kerb);
      }
    for (double x = 2.0; x <= 4.0; x += 0.05)
      for (double z = 0.0; z < 2.0; z += 0.05) add(x, 3.0, groundAt(3.0) + z);
    for (double x = 4.5; x <= 5.5; x += 0.05) add(x, 1.0, groundAt(1.0) + 2.5);
  }
  struct GridImage {
    GroundGrid ground;
    std::vector<std::uint8_t> image;
  };
  void add(double x, double y, double z) {
    MapPoint point;
    point.p = Vector3d(x, y, z).cast<float>();
    points_.push_back(point);
  }
  std::uint8_t at(const GridImage& grid, double x, double y) const {
    const int u = static_cast<int>(std::floor((x - grid.ground.x0()) / model_.resolution));
    const int v = grid.ground.height() - 1 - static_cast<int>(std::floor((y - grid.ground.y0()) / model_.resolution));
    return grid.image[static_cast<std::size_t>(v) * static_cast<std::size_t>(grid.ground.width()) +
                      static_cast<std::size_t>(u)];
  }
  GridImage build() const {
    GroundGrid ground(model_, path_);
    ground.addSurface(points_);
    ground.find();
    OccupancyGrid grid(ground);
    grid.addBeams(points_, [](const MapPoint& point) { return Vector3d(static_cast<double>(point.p.x()), 0.0, 1.0); });
    return {ground, grid.image()};
  }

  const GridModel model_;
  std::vector<Vector3d> path_;
  std::vector<MapPoint> points_;
};

TEST_F(OccupancyGridTest, ObstaclesAreMeasuredFromTheGroundAroundThem) {
  const GridImage grid = build();
  EXPECT_EQ(at(grid, 3.0, 3.02), 0) << "wall";
  EXPECT_EQ(at(grid, 8.0, -2.05), 0) << "kerb";
  EXPECT_EQ(at(grid, 8.0, -2.6), 254) << "on the pavement";
  EXPECT_EQ(at(grid, 5.0, 1.02), 254) << "below the arch";
  for (double y = -1.5; y < 5.0; y += 0.1) EXPECT_EQ(at(grid, 8.0, y), 254) << "slope at " << y;
}

TEST_F(OccupancyGridTest, ErroneousPointsBelowTheGroundMakeNoObstacles) {
  add(8.02, 2.02, groundAt(2.02) - 0.2);
  add(8.12, 2.02, groundAt(2.02) - 0.2);
  const GridImage grid = build();
  for (double x = 7.75; x < 8.4; x += 0.1)
    for (double y = 1.75; y < 2.4; y += 0.1) EXPECT_EQ(at(grid, x, y), 254) << x << ", " << y;
}

TEST_F(OccupancyGridTest, CellsThatNoBeamReachedAreUnknown) {
  const GridImage grid = build();
  EXPECT_EQ(at(grid, 8.0, 6.0), 254) << "passed";
  EXPECT_EQ(at(grid, 8.0, 9.5), 205);
  EXPECT_EQ(at(grid, 20.0, 0.0), 205);
}

TEST_F(OccupancyGridTest, WhereTheRobotDroveIsFree) {
  add(5.0, 0.0, 0.5);
  add(5.0, 0.0, 0.6);
  add(5.0, 0.0, 0.7);
  const GridImage grid = build();
  for (const Vector3d& p : path_) EXPECT_EQ(at(grid, p.x(), p.y()), 254);
}

TEST_F(OccupancyGridTest, MapServerReadsItsFiles) {
  const GridImage grid = build();
  EXPECT_EQ(printGridYaml(localPlacement(grid.ground), "map.pgm").substr(0, 32), "image: map.pgm\nresolution: 0.1\no");
  const std::string pgm = printPgm(grid.image, grid.ground.width(), grid.ground.height());
  const std::string header =
      "P5\n" + std::to_string(grid.ground.width()) + " " + std::to_string(grid.ground.height()) + "\n255\n";
  EXPECT_EQ(pgm.substr(0, header.size()), header);
  EXPECT_EQ(pgm.size(), header.size() + grid.image.size());
}

TEST(GridYaml, HasTheOriginWithItsYaw) {
  EXPECT_EQ(printGridYaml({0.1, -30.0, 2.5, 0.25}, "m.pgm"),
            "image: m.pgm\nresolution: 0.1\norigin: [-30, 2.5, 0.25]\nnegate: 0\noccupied_thresh: 0.65\n"
            "free_thresh: 0.196\n");
}

}  // namespace
}  // namespace laser_mapper
