// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <tuple>

#include "commands/commands.hpp"
#include "commands/stages.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Vector3d;
using urban_nav_input::testing::readFile;

/// Drive of a robot whose only sensor is a 3D LiDAR, mapped and labelled once for all tests.
class LidarLabels : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<urban_nav_input::testing::TemporaryFolder>();
    ASSERT_EQ(run({"simulate", "--world", "street", "--seed", "5", "--duration", "12", "--sensors", "lidar3d",
                   "--lidar", "16", "-o", file("drive.bag")}),
              0);
    ASSERT_EQ(run({"map", file("drive.bag"), "--stages", "lo,graph,lasers,labels", "--out", file("map")}), 0);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string file(const std::string& name) { return folder_->file(name); }
  static int run(std::vector<std::string> words) {
    std::vector<const char*> argv = {"urban_nav"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine(allCommands(), addStageTables, static_cast<int>(argv.size()), argv.data());
  }

  static std::unique_ptr<urban_nav_input::testing::TemporaryFolder> folder_;
};
std::unique_ptr<urban_nav_input::testing::TemporaryFolder> LidarLabels::folder_;

/// Classes of the true surfaces in cubes of 0.3 m.
class TrueClasses {
 public:
  explicit TrueClasses(const std::string& path) {
    const urban_nav_core::NumberColumns columns = urban_nav_core::readCloudColumns(path, {"x", "y", "z", "class"});
    for (std::size_t i = 0; i < columns[3]->size(); ++i)
      classes_[cube({(*columns[0])[i], (*columns[1])[i], (*columns[2])[i]})] = static_cast<int>((*columns[3])[i]);
  }
  /// Returns 255 where there is no surface.
  int at(const Vector3d& p) const {
    const auto found = classes_.find(cube(p));
    return found == classes_.end() ? 255 : found->second;
  }

 private:
  static std::tuple<int, int, int> cube(const Vector3d& p) {
    return {static_cast<int>(std::floor(p.x() / 0.3)), static_cast<int>(std::floor(p.y() / 0.3)),
            static_cast<int>(std::floor(p.z() / 0.3))};
  }
  std::map<std::tuple<int, int, int>, int> classes_;
};

bool isGround(int label) { return label >= 1 && label <= 3; }

TEST_F(LidarLabels, AreThoseOfTheSurfacesThatTheSweepsMeasured) {
  const urban_nav_core::NumberColumns columns =
      urban_nav_core::readCloudColumns(file("map/map.ply"), {"x", "y", "z", "label", "label_probability", "unsure"});
  for (const auto& column : columns) ASSERT_TRUE(column.has_value());
  const TrueClasses truth(file("drive.truth/cloud.ply"));
  const urban_nav_core::Trajectory map = urban_nav_core::readTum(file("map/trajectory.tum")),
                                   world = urban_nav_core::readTum(file("drive.truth/trajectory.tum"));
  const urban_nav_core::Pose T_world_map = world[world.nearest(map[0].stamp)].pose * map[0].pose.inverse();
  std::size_t points = 0, compared = 0, right = 0;
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    const int label = static_cast<int>((*columns[3])[i]);
    points += label != 255 ? 1U : 0U;
    ASSERT_TRUE(label == 255 || ((*columns[4])[i] > 0.0 && (*columns[4])[i] <= 1.0));
    const int surface = truth.at(T_world_map * Vector3d((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]));
    if (surface == 255 || label == 255) continue;
    ++compared;
    right += isGround(label) == isGround(surface) ? 1U : 0U;
  }
  EXPECT_GT(points, 50000U);
  EXPECT_GT(points, 99 * columns[0]->size() / 100) << "every point has a label";
  ASSERT_GT(compared, points / 2);
  EXPECT_GT(right, 8 * compared / 10) << "ground or not";
  std::cout << right << " of " << compared << " points are ground or not as in truth" << std::endl;
}

TEST_F(LidarLabels, AreInTheSummaryTheTablesAndTheReport) {
  const urban_nav_core::CsvTable labels = urban_nav_core::CsvTable::read(file("map/labels.csv"));
  EXPECT_GE(labels.rows(), 3U);
  const std::string summary = readFile(file("map/summary.json"));
  EXPECT_NE(summary.find("\"points_labelled\""), std::string::npos);
  EXPECT_NE(summary.find("\"instances\""), std::string::npos);
  const std::string report = readFile(file("map/report.html"));
  EXPECT_NE(report.find("Classes of the map"), std::string::npos);
  EXPECT_NE(report.find("instances.csv"), std::string::npos);
  const urban_nav_core::CsvTable objects = urban_nav_core::CsvTable::read(file("map/instances.csv"));
  const std::size_t length = objects.column("length_m"), width = objects.column("width_m"),
                    first = objects.column("first_ns"), last = objects.column("last_ns");
  for (std::size_t row = 0; row < objects.rows(); ++row) {
    EXPECT_GE(objects.number(row, length), objects.number(row, width));
    EXPECT_LE(objects.integer(row, first), objects.integer(row, last));
  }
}

TEST_F(LidarLabels, ABagWithoutImagesIsLabelledSweepBySweep) {
  ASSERT_EQ(run({"labels", "apply", "default", file("drive.bag"), "--formats", "csv,ply", "--output", file("labels")}),
            0);
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(file("labels/points0_labels.csv"));
  const std::size_t x = table.column("x"), y = table.column("y"), z = table.column("z"), label = table.column("label"),
                    unsure = table.column("unsure");
  const TrueClasses truth(file("drive.truth/cloud.ply"));
  const urban_nav_core::Trajectory map = urban_nav_core::readTum(file("map/trajectory.tum")),
                                   world = urban_nav_core::readTum(file("drive.truth/trajectory.tum"));
  const urban_nav_core::Pose T_world_odom = world[world.nearest(map[0].stamp)].pose;  // odom: the first base_link
  std::size_t answered = 0, compared = 0, right = 0;
  for (std::size_t row = 0; row < table.rows(); row += 7) {
    const std::int64_t found = table.integer(row, label);
    EXPECT_EQ(found == 255, table.text(row, unsure).empty());
    answered += found != 255 ? 1U : 0U;
    const int surface =
        truth.at(T_world_odom * Vector3d(table.number(row, x), table.number(row, y), table.number(row, z)));
    if (surface == 255 || found == 255) continue;
    ++compared;
    right += isGround(static_cast<int>(found)) == isGround(surface) ? 1U : 0U;
  }
  EXPECT_GT(answered, table.rows() / 14) << "half of the returns are within reach";
  ASSERT_GT(compared, 10000U);
  EXPECT_GT(right, 95 * compared / 100);
  const urban_nav_core::NumberColumns cloud =
      urban_nav_core::readCloudColumns(file("labels/points0_labels.ply"), {"x", "label", "unsure", "stamp"});
  for (const auto& column : cloud) ASSERT_TRUE(column.has_value());
  EXPECT_EQ(cloud[0]->size(), table.rows());
}

}  // namespace
}  // namespace urban_nav
