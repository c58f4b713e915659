// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "laser_mapper/georeference/map_projection.hpp"
#include "support/map_export_fixture.hpp"
#include "support/read_geotiff.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_fix.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Vector3d;

/// Position on the earth of a point of the map of MapExportTest: x to the north, from 51.75 deg N, 1.25 deg W;
/// base_link is at a height of 99 m.
Vector3d placeOnEarth(const Vector3d& p_map) {
  const urban_nav_core::LocalTangent tangent({51.75 * M_PI / 180.0, -1.25 * M_PI / 180.0, 99.0});
  return laser_mapper::MapProjection(32630, "").project(tangent.toGeodetic(Vector3d(-p_map.y(), p_map.x(), p_map.z())));
}

/// Exports all formats in a coordinate system.
class OneSystemTest : public MapExportTest {
 protected:
  OneSystemTest() {
    render();
    paths_ = {"", "", folder_.file("m.las"), folder_.file("g.yaml"), folder_.file("o.png")};
    paths_.mesh = folder_.file("m.ply");
    paths_.geotiff = folder_.file("o.tif");
    paths_.elevation = folder_.file("h.tif");
    paths_.slope = folder_.file("s.tif");
    paths_.traversability = folder_.file("t.tif");
    paths_.crs = "EPSG:32630";
  }
  void putFixes() {
    urban_nav_store::TableStore<urban_nav_store::StoredFix> fixes(store_);
    for (int i = 0; i <= 160; i += 10)
      fixes.put({kExportSession, kExportStart + i * 50'000'000LL, 51.75 + 0.05 * i / 111258.0, -1.25, 100.0, 0.02, 0.02,
                 0.05, 0.0, 0.0, 1.0});
  }
  void expectTheWallInEveryFile();

  MapFilePaths paths_;
};

/// The wall at y = 4 and the ground before it, in LAS, orthophoto, grid, height model, slope and mesh.
void OneSystemTest::expectTheWallInEveryFile() {
  const ReadGeoTiff photo = readGeoTiff(paths_.geotiff), heights = readGeoTiff(paths_.elevation),
                    slopes = readGeoTiff(paths_.slope), easy = readGeoTiff(paths_.traversability);
  for (const ReadGeoTiff* tiff : {&photo, &heights, &slopes, &easy}) EXPECT_EQ(tiff->epsg, 32630);
  ASSERT_EQ(photo.image.type(), CV_8UC4);
  ASSERT_EQ(heights.image.type(), CV_32FC1);
  std::array<double, 6> world{};
  ASSERT_EQ(std::sscanf(urban_nav_input::testing::readFile(folder_.file("g.pgw")).c_str(), "%lf %lf %lf %lf %lf %lf",
                        &world[0], &world[1], &world[2], &world[3], &world[4], &world[5]),
            6);
  EXPECT_EQ(world[1], 0.0) << "the image points north";
  EXPECT_EQ(world[2], 0.0);
  const cv::Mat grid = cv::imread(folder_.file("g.pgm"), cv::IMREAD_UNCHANGED);
  const auto las = urban_nav_core::readCloud(paths_.las);
  const auto mesh = urban_nav_core::readCloud(paths_.mesh).cloud.points;
  const std::string sidecar = urban_nav_input::testing::readFile(folder_.file("m.json"));
  EXPECT_NE(sidecar.find("\"crs\": \"EPSG:32630\""), std::string::npos) << sidecar;
  Vector3d offset;
  ASSERT_EQ(
      std::sscanf(sidecar.substr(sidecar.find('[')).c_str(), "[ %lf, %lf, %lf", &offset.x(), &offset.y(), &offset.z()),
      3)
      << sidecar;
  const auto around = [](const cv::Mat& image, cv::Point p, const auto& holds) {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du) {
        const cv::Point q(p.x + du, p.y + dv);
        if (q.x >= 0 && q.y >= 0 && q.x < image.cols && q.y < image.rows && holds(q)) return true;
      }
    return false;
  };
  for (double x = 1.5; x < 7.0; x += 0.5) {
    const Vector3d wall = placeOnEarth({x, 4.0, 0.5}), ground = placeOnEarth({x, 2.5, 0.0}),
                   beyond = placeOnEarth({x, 4.5, 0.5});
    EXPECT_TRUE(around(photo.image, photo.at(wall.x(), wall.y()),
                       [&](cv::Point p) { return photo.image.at<cv::Vec4b>(p)[3] == 255; }));
    const cv::Point nothing = photo.at(beyond.x(), beyond.y());
    EXPECT_TRUE(nothing.x < 0 || photo.image.at<cv::Vec4b>(nothing)[3] == 0);
    const cv::Point cell(static_cast<int>(std::lround((wall.x() - world[4]) / world[0])),
                         static_cast<int>(std::lround((wall.y() - world[5]) / world[3])));
    EXPECT_TRUE(around(grid, cell, [&](cv::Point p) { return grid.at<std::uint8_t>(p) == 0; })) << "grid at " << x;
    const auto isFlat = [&](cv::Point p) {  // no beam ends in some of the cells
      const float height = heights.image.at<float>(p);
      return std::abs(height - 99.0F) < 0.02F && slopes.image.at<float>(p) < 0.5F &&
             slopes.image.at<float>(p) >= 0.0F && easy.image.at<float>(p) > 0.9F;
    };
    EXPECT_TRUE(around(heights.image, heights.at(ground.x(), ground.y()), isFlat)) << x;
    double nearest_las = 1e9, nearest_mesh = 1e9;
    for (const Eigen::Vector3f& p : las.cloud.points)
      nearest_las = std::min(nearest_las, (p.cast<double>() + las.offset - wall).norm());
    for (const Eigen::Vector3f& p : mesh)
      nearest_mesh = std::min(nearest_mesh, (p.cast<double>() + offset - wall).norm());
    EXPECT_LT(nearest_las, 0.06) << x;
    EXPECT_LT(nearest_mesh, 0.1) << x;
  }
}

TEST_F(OneSystemTest, FixesPlaceEveryFile) {
  putFixes();
  const ExportedMap exported = exportMap(store_, map(), paths_, 100.0);
  EXPECT_EQ(exported.files.size(), 8U);
  expectTheWallInEveryFile();
  for (const char* name : {"o.prj", "g.prj"})
    EXPECT_NE(urban_nav_input::testing::readFile(folder_.file(name)).find("WGS_1984_UTM_Zone_30N"), std::string::npos);
  const std::string yaml = urban_nav_input::testing::readFile(folder_.file("g.yaml"));
  double x = 0.0, y = 0.0, yaw = 0.0;
  ASSERT_EQ(std::sscanf(yaml.substr(yaml.find('[')).c_str(), "[%lf, %lf, %lf]", &x, &y, &yaw), 3) << yaml;
  const double convergence = 1.75 * std::sin(51.75 * M_PI / 180.0) * M_PI / 180.0;  // the meridian is at 3 deg W
  EXPECT_NEAR(yaw, -M_PI / 2.0 - convergence, 2e-3) << "east of the grid in map";
}

TEST_F(OneSystemTest, SurveyedPointsPlaceEveryFile) {
  paths_.control = folder_.file("control.csv");
  std::string csv = "name,x,y,z,map_x,map_y,map_z\n";
  for (const Vector3d& p : {Vector3d(0, 4, 0), Vector3d(8, 4, 0), Vector3d(4, 0, 0)}) {
    const Vector3d q = placeOnEarth(p);
    char row[200];
    std::snprintf(row, sizeof row, "post,%.4f,%.4f,%.4f,%g,%g,%g\n", q.x(), q.y(), q.z(), p.x(), p.y(), p.z());
    csv += row;
  }
  urban_nav_input::testing::writeFile(paths_.control, csv);
  const ExportedMap exported = exportMap(store_, map(), paths_, 100.0);
  ASSERT_EQ(exported.control.size(), 3U);
  EXPECT_EQ(exported.control[0].name, "post");
  for (const MapCrs::ControlError& point : exported.control) EXPECT_LT(point.error, 1e-3);
  expectTheWallInEveryFile();
}

TEST_F(OneSystemTest, ControlNeedsItsSystemAndItsColumns) {
  paths_.control = folder_.file("control.csv");
  urban_nav_input::testing::writeFile(paths_.control, "name,x,y,z,map_x,map_y\na,1,2,3,4,5\n");
  EXPECT_THROW(exportMap(store_, map(), paths_, 100.0), urban_nav_core::UserError);
  urban_nav_input::testing::writeFile(paths_.control, "name,x,y,z,map_x,map_y,map_z\na,500000,5700000,3,4,5,6\n");
  EXPECT_THROW(exportMap(store_, map(), paths_, 100.0), urban_nav_core::DataError) << "one point";
  paths_.crs = "auto";
  EXPECT_THROW(exportMap(store_, map(), paths_, 100.0), urban_nav_core::UserError);
  EXPECT_FALSE(std::filesystem::exists(paths_.las));
}

TEST_F(OneSystemTest, WithoutSystemEveryFileIsInTheFrameMap) {
  paths_.crs = "";
  paths_.octomap = folder_.file("o.bt");
  exportMap(store_, map(), paths_, 100.0);
  const ReadGeoTiff photo = readGeoTiff(paths_.geotiff), heights = readGeoTiff(paths_.elevation);
  EXPECT_EQ(photo.epsg, 0);
  EXPECT_EQ(photo.image.at<cv::Vec4b>(photo.at(4.0, 4.0 + 0.4))[3], 0) << "beyond the wall";
  EXPECT_NEAR(heights.image.at<float>(heights.at(4.05, 1.15)), 0.0, 0.02);
  EXPECT_NEAR(
      std::max(heights.image.at<float>(heights.at(4.05, 3.95)), heights.image.at<float>(heights.at(4.05, 4.05))), 1.45,
      0.1)
      << "the wall, up to the robot's height";
  for (const char* name : {"m.json", "o.prj", "g.prj", "g.pgw"})
    EXPECT_FALSE(std::filesystem::exists(folder_.file(name))) << name;
  EXPECT_EQ(urban_nav_input::testing::readFile(paths_.octomap).substr(0, 29), "# Octomap OcTree binary file\n");
}

TEST_F(OneSystemTest, ASecondExportHasTheSameBytes) {
  putFixes();
  exportMap(store_, map(), paths_, 100.0);
  std::vector<std::string> first;
  for (const std::string* path : paths_.all())
    if (!path->empty()) first.push_back(urban_nav_input::testing::readFile(*path));
  exportMap(store_, map(), paths_, 100.0);
  std::size_t i = 0;
  for (const std::string* path : paths_.all()) {
    if (path->empty()) continue;
    EXPECT_EQ(urban_nav_input::testing::readFile(*path) == first[i++], true) << *path;
  }
}

TEST_F(OneSystemTest, GroundIsClassTwoWithoutLabels) {
  paths_.crs = "";
  exportMap(store_, map(), paths_, 100.0);
  const std::string las = urban_nav_input::testing::readFile(paths_.las);
  std::uint32_t offset = 0;
  std::uint16_t length = 0;
  std::memcpy(&offset, las.data() + 96, sizeof offset);
  std::memcpy(&length, las.data() + 105, sizeof length);
  std::size_t ground = 0, wrong = 0;
  const auto points = urban_nav_core::readCloud(paths_.las).cloud.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int kind = las[offset + i * length + 16];
    ground += kind == 2 ? 1 : 0;
    const bool is_ground = points[i].y()<3.9F, is_wall = points[i].z()> 0.15F;
    if ((is_ground && kind != 2) || (is_wall && kind != 1)) ++wrong;
  }
  EXPECT_GT(ground, points.size() / 10);
  EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace urban_nav
