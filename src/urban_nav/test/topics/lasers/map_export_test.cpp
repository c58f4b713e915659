// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_export.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "support/map_export_fixture.hpp"
#include "topics/labels/labelled_map.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_fix.hpp"

namespace urban_nav {
namespace {

TEST_F(MapExportTest, EveryFormatHasThePointsOfTheMap) {
  render();
  const MapFilePaths paths{folder_.file("m.ply"), folder_.file("m.pcd"), folder_.file("m.las"), "", ""};
  const ExportedMap made = exportMap(store_, map(), paths, 100.0);
  EXPECT_EQ(made.files.size(), 3U);
  ASSERT_GT(made.points, 1000U);
  const auto ply = urban_nav_core::readCloud(paths.ply).cloud.points;
  ASSERT_EQ(ply.size(), made.points);
  for (const std::string& path : {paths.pcd, paths.las}) {
    const auto read = urban_nav_core::readCloud(path).cloud.points;
    ASSERT_EQ(read.size(), ply.size());
    for (std::size_t i = 0; i < ply.size(); ++i) ASSERT_LT((read[i] - ply[i]).norm(), 2e-4F) << path;
  }
  for (const Eigen::Vector3f& p : ply) EXPECT_LT(std::min(std::abs(p.y() - 4.0F), std::abs(p.z())), 0.01F);
}

TEST_F(MapExportTest, LabelsOfTheMapBecomeColumnsAndClassesOfTheAsprs) {
  render();
  const MapFilePaths paths{folder_.file("m.ply"), "", folder_.file("m.las"), "", ""};
  const std::size_t points = exportMap(store_, map(), paths, 100.0).points;
  const auto plain_bytes = std::filesystem::file_size(paths.las);
  const std::vector<scene_labeler::PointLabel> labels(points, {scene_labeler::SceneClass::Paved, 255, false});
  MapPointsDigest digest;
  storeMapLabels(store_, kExportSession, digest, labels);
  exportMap(store_, map(), paths, 100.0, labelAttributes);
  EXPECT_FALSE(urban_nav_core::readCloudColumns(paths.ply, {"label"})[0]) << "labels of another map";

  const auto stored = map();
  const urban_nav_core::Trajectory T_map_base(stored.front().T_map_base);
  const laser_mapper::MappedSession session{kExportSession, &T_map_base, nullptr};
  laser_mapper::LaserMap laser_map(*laser_mapper::storedMapParameters(store_, kExportSession), store_, {session});
  laser_map.load();
  laser_map.forEachTile(
      [&](const laser_mapper::Tile&, const std::vector<laser_mapper::MapPoint>& tile) { digest.add(tile); });
  storeMapLabels(store_, kExportSession, digest, labels);
  exportMap(store_, map(), paths, 100.0, labelAttributes);
  const auto columns = urban_nav_core::readCloudColumns(paths.ply, {"label", "label_probability", "unsure"});
  ASSERT_TRUE(columns[0] && columns[1] && columns[2]);
  EXPECT_EQ(*columns[0], std::vector<double>(points, 2.0));
  EXPECT_EQ(*columns[1], std::vector<double>(points, 1.0));
  EXPECT_GT(std::filesystem::file_size(paths.las), plain_bytes + points - 1);
  const std::string las = urban_nav_input::testing::readFile(paths.las);
  std::uint32_t offset = 0;
  std::memcpy(&offset, las.data() + 96, sizeof offset);
  EXPECT_EQ(las[offset + 16], 2) << "classification of point format 7: paved is ground";
}

TEST_F(MapExportTest, AMapWithoutFixesHasNoCoordinateSystem) {
  render();
  MapFilePaths paths{"", "", folder_.file("m.las"), "", ""};
  for (const std::string crs : {"auto", "EPSG:32630"}) {
    paths.crs = crs;
    EXPECT_THROW(exportMap(store_, map(), paths, 100.0), urban_nav_core::DataError);
    EXPECT_FALSE(std::filesystem::exists(paths.las));
  }
}

TEST_F(MapExportTest, FixesPlaceTheLasFileOnTheEarth) {
  render();
  urban_nav_store::TableStore<urban_nav_store::StoredFix> fixes(store_);
  for (int i = 0; i <= 160; i += 10)  // x of the map to the north, from 51.75 deg N, 1.25 deg W; exact to a centimetre
    fixes.put({kExportSession, kExportStart + i * 50'000'000LL, 51.75 + 0.05 * i / 111258.0, -1.25, 100.0, 0.02, 0.02,
               0.05, 0.0, 0.0, 1.0});
  MapFilePaths paths{folder_.file("m.ply"), "", folder_.file("m.las"), "", ""};
  paths.crs = "auto";
  const ExportedMap made = exportMap(store_, map(), paths, 100.0);
  EXPECT_EQ(made.epsg, 32630);
  ASSERT_TRUE(made.reference);
  EXPECT_EQ(made.reference->fixes, 17U);
  const auto ply = urban_nav_core::readCloud(paths.ply).cloud.points;
  const std::string las = urban_nav_input::testing::readFile(paths.las);
  EXPECT_NE(las.find("UTM zone 30N"), std::string::npos);
  const auto read = urban_nav_core::readCloud(paths.las);
  ASSERT_EQ(read.cloud.points.size(), ply.size());
  // Distances are those of the map but for the scale of the projection, and the height is that of the fixes.
  for (std::size_t i = 1; i < ply.size(); i += 97) {
    const float in_map = (ply[i] - ply[0]).norm(), in_las = (read.cloud.points[i] - read.cloud.points[0]).norm();
    EXPECT_NEAR(in_las, in_map, 4e-4F * in_map + 3e-4F);
  }
}

TEST_F(MapExportTest, GridShowsTheWallAndTheGroundBeforeIt) {
  render();
  exportMap(store_, map(), {"", "", "", folder_.file("m.yaml"), ""}, 100.0);
  const std::string yaml = urban_nav_input::testing::readFile(folder_.file("m.yaml")),
                    pgm = urban_nav_input::testing::readFile(folder_.file("m.pgm"));
  EXPECT_NE(yaml.find("image: m.pgm\nresolution: 0.1\norigin: [-30, -30, 0]\n"), std::string::npos) << yaml;
  int width = 0, height = 0;
  ASSERT_EQ(std::sscanf(pgm.c_str(), "P5\n%d %d\n255\n", &width, &height), 2);
  const auto at = [&](double x, double y) {
    const int u = static_cast<int>(std::floor((x + 30.0) / 0.1)), v = static_cast<int>(std::floor((y + 30.0) / 0.1));
    return static_cast<int>(static_cast<unsigned char>(pgm[pgm.size() - static_cast<std::size_t>(width * height) +
                                                           static_cast<std::size_t>((height - 1 - v) * width + u)]));
  };
  for (double x = 1.05; x < 7.0; x += 0.1) {
    EXPECT_TRUE(at(x, 3.95) == 0 || at(x, 4.05) == 0) << "wall at " << x;
    for (double y = 0.05; y < 3.8; y += 0.1) EXPECT_EQ(at(x, y), 254) << x << " " << y;
    EXPECT_EQ(at(x, 4.55), 205) << "beyond the wall";
  }
}

TEST_F(MapExportTest, OrthophotoIsPlacedByItsWorldFile) {
  render();
  exportMap(store_, map(), {"", "", "", "", folder_.file("m.png")}, 100.0);
  double step_x = 0.0, a = 1.0, b = 1.0, step_y = 0.0, x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(urban_nav_input::testing::readFile(folder_.file("m.pgw")).c_str(), "%lf %lf %lf %lf %lf %lf",
                        &step_x, &a, &b, &step_y, &x, &y),
            6);
  EXPECT_NEAR(step_x, 0.05, 1e-9);
  EXPECT_NEAR(step_y, -0.05, 1e-9);
  EXPECT_EQ(a, 0.0);
  EXPECT_EQ(b, 0.0);
  EXPECT_NEAR(x, -0.6, 0.15) << "the path begins at 0, the edge is 12 px wide";
  EXPECT_NEAR(y, 4.0 + 0.6, 0.15) << "the wall is at 4";
  EXPECT_EQ(urban_nav_input::testing::readFile(folder_.file("m.png")).substr(1, 3), "PNG");
}

TEST_F(MapExportTest, TheMeshIsTheWallAndTheGround) {
  render();
  MapFilePaths paths;
  paths.mesh = folder_.file("mesh.ply");
  EXPECT_EQ(exportMap(store_, map(), paths, 100.0).files, std::vector<std::string>{paths.mesh});
  const auto vertices = urban_nav_core::readCloud(paths.mesh).cloud.points;
  ASSERT_GT(vertices.size(), 1000U);
  std::size_t wall = 0, ground = 0;
  for (const Eigen::Vector3f& p : vertices) {
    const float to_wall = std::abs(p.y() - 4.0F), to_ground = std::abs(p.z());
    EXPECT_LT(std::min(to_wall, to_ground), p.y() > 3.5F && p.z() < 0.5F ? 0.12F : 0.01F) << "corners are rounded";
    wall += to_wall < to_ground ? 1 : 0;
    ground += to_wall < to_ground ? 0 : 1;
  }
  EXPECT_GT(wall, 500U);
  EXPECT_GT(ground, 500U);
}

TEST_F(MapExportTest, RefusesAStoreWithoutAMap) {
  EXPECT_FALSE(holdsMap(store_, map()));
  EXPECT_THROW(exportMap(store_, map(), {folder_.file("m.ply"), "", "", "", ""}, 100.0), urban_nav_core::DataError);
  EXPECT_FALSE(std::filesystem::exists(folder_.file("m.ply")));
}

}  // namespace
}  // namespace urban_nav
