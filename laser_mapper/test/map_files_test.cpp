// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_files.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/io/cloud/cloud_file.hpp"

namespace laser_mapper {
namespace {

std::vector<MapPoint> pointsForFiles() {
  std::vector<MapPoint> points(100);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto k = static_cast<float>(i);
    points[i].p = {0.1F * k, -0.2F * k, 1.0F};
    points[i].normal = Eigen::Vector3f::UnitZ();
    points[i].red = static_cast<std::uint8_t>(2 * i);
    points[i].laser = i % 2 == 0 ? 0 : 1;
    points[i].pass = static_cast<std::uint16_t>(i / 10);
    points[i].stamp = 1'225'719'873'000'000'000;
  }
  return points;
}

std::string mapFileTestPath(const char* extension) { return ::testing::TempDir() + "map_files_test." + extension; }

TEST(MapFiles, EveryFormatReadsBackWithTheSamePoints) {
  const std::vector<MapPoint> points = pointsForFiles();
  urban_nav_core::PlyWriter ply(mapFileTestPath("ply"), mapLayout());
  urban_nav_core::PcdWriter pcd(mapFileTestPath("pcd"), mapPcdFields());
  urban_nav_core::LasWriter las(mapFileTestPath("las"), mapLasAttributes(), "");
  for (const MapPoint& point : points) {
    std::string vertex, pcd_point, attributes;
    appendVertex(vertex, point);
    appendPcdPoint(pcd_point, point);
    appendLasAttributes(attributes, point);
    ply.append(vertex);
    pcd.append(pcd_point);
    las.append(lasPoint(point), attributes);
  }
  ply.commit();
  pcd.commit();
  las.commit();
  for (const char* extension : {"ply", "pcd", "las"}) {
    const auto read = urban_nav_core::readCloud(mapFileTestPath(extension)).cloud.points;
    ASSERT_EQ(read.size(), points.size()) << extension;
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((read[i] - points[i].p).norm(), 2e-4F) << extension;
  }
}

TEST(MapFiles, LasPointsUseTheWholeRangeOfTheirTypes) {
  MapPoint point;
  point.red = point.intensity = 255;
  point.laser = 255;
  point.pass = 65535;
  const urban_nav_core::LasPoint las = lasPoint(point);
  EXPECT_EQ(las.red, 65535);
  EXPECT_EQ(las.intensity, 65535);
  EXPECT_EQ(las.channel, 3);
  EXPECT_EQ(las.source, 65535);
}

}  // namespace
}  // namespace laser_mapper
