// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "commands/stages.hpp"
#include "scene_labeler/class_map.hpp"
#include "support/shared_drive.hpp"
#include "topics/labels/label_score.hpp"
#include "topics/labels/labels.hpp"
#include "topics/vo/vo.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using scene_labeler::ClassMap;
using scene_labeler::SceneClass;

class Labels : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  int labels(std::vector<std::string> words) const {
    words.insert(words.begin(), {"urban_nav", "labels"});
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({labelsCommand(runOdometry)}, addStageTables, static_cast<int>(argv.size()), argv.data());
  }
  /// Ground of label 20 and a wall of label 30 in `folder`, its labels in the order of `scrambled`.
  void writeScene(const std::string& folder, const std::string& name, unsigned seed, bool scrambled = false) const {
    std::mt19937 random(seed);
    const auto draw = [&random](double high) {
      return std::to_string(high * static_cast<double>(random() % 1000) / 1e3);
    };
    std::string text = "x,y,z,label\n";
    for (int i = 0; i < 3000; ++i) {
      const bool is_ground = i % 2 == 0;
      const std::string label = is_ground != (scrambled && i % 4 < 2) ? "20" : "30";
      text += is_ground ? draw(6) + "," + draw(6) + "," + draw(0.02) + "," + label + "\n"
                        : "6," + draw(6) + "," + draw(3) + "," + label + "\n";
    }
    std::filesystem::create_directories(path(folder));
    urban_nav_input::testing::writeFile(path(folder + "/" + name + "_points.csv"), text);
  }
  void writeClasses() const {
    urban_nav_input::testing::writeFile(path("classes.csv"), "id,class\n20,paved\n30,wall\n");
  }
  int train(const std::string& model, std::vector<std::string> sources) const {
    sources.insert(sources.begin(), "train");
    sources.insert(sources.end(), {"-o", path(model), "--classes", path("classes.csv")});
    return labels(sources);
  }

 private:
  const urban_nav_input::testing::TemporaryFolder folder_;
};

TEST_F(Labels, AreFoundInAnotherSceneWhateverItsLabels) {
  writeScene("train", "a", 1);
  writeScene("train", "b", 2);
  writeScene("find", "c", 3);
  writeScene("blind", "c", 3, true);
  writeClasses();
  ASSERT_EQ(train("m", {path("train")}), 0);
  ASSERT_EQ(labels({"apply", path("m"), path("find"), "-o", path("out")}), 0);
  ASSERT_EQ(labels({"apply", path("m"), path("blind"), "-o", path("again"), "--threads", "1"}), 0);
  EXPECT_EQ(urban_nav_input::testing::readFile(path("out/c_labels.csv")),
            urban_nav_input::testing::readFile(path("again/c_labels.csv")));
  const auto table = urban_nav_core::CsvTable::read(path("out/c_labels.csv"));
  EXPECT_EQ(table.header(), (std::vector<std::string>{"index", "label", "probability", "p_paved", "p_wall", "unsure"}));
  ASSERT_EQ(table.rows(), 3000u);
  int right = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    EXPECT_NEAR(table.number(i, 3) + table.number(i, 4), 1.0, 1e-4);
    right += table.integer(i, 1) == (i % 2 == 0 ? 2 : 8) ? 1 : 0;
  }
  EXPECT_GT(right, 2800);
}

/// Columns of the labels of scene c in a folder, as CSV, PLY or LAS.
urban_nav_core::NumberColumns readLabelColumns(const std::string& base) {
  return urban_nav_core::readCloudColumns(base, {"label", "unsure", "x", "y", "z", "label_probability"});
}

TEST_F(Labels, AreTheSameInAllFormats) {
  writeScene("train", "a", 1);
  writeScene("train", "b", 2);
  writeScene("find", "c", 3);
  writeClasses();
  ASSERT_EQ(train("m", {path("train")}), 0);
  ASSERT_EQ(labels({"apply", path("m"), path("find"), "-o", path("out")}), 0);
  const auto table = urban_nav_core::CsvTable::read(path("out/c_labels.csv"));
  const auto points = urban_nav_core::readCloudColumns(path("find/c_points.csv"), {"x", "y", "z"});
  for (const char* file : {"out/c_labels.ply", "out/c_labels.las"}) {
    const auto columns = readLabelColumns(path(file));
    ASSERT_EQ(columns[0].value().size(), table.rows()) << file;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      ASSERT_EQ((*columns[0])[i], table.number(i, 1)) << file;
      ASSERT_EQ((*columns[1])[i], table.number(i, 5)) << file;
      ASSERT_NEAR((*columns[5])[i], table.number(i, 2), 1e-5) << file;
      for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_NEAR((*columns[2 + axis])[i], (*points[axis])[i], 1e-4);
    }
  }
  const auto codes = urban_nav_core::readCloudColumns(path("out/c_labels.las"), {"classification"})[0].value();
  for (std::size_t i = 0; i < table.rows(); ++i)
    ASSERT_EQ(codes[i], table.integer(i, 1) == 2 ? 2.0 : 6.0) << "ground, building";
  ASSERT_EQ(labels({"apply", path("m"), path("find"), "-o", path("one"), "--formats", "las"}), 0);
  EXPECT_FALSE(std::filesystem::exists(path("one/c_labels.csv")));
  EXPECT_EQ(urban_nav_input::testing::readFile(path("one/c_labels.las")),
            urban_nav_input::testing::readFile(path("out/c_labels.las")));
  EXPECT_EQ(labels({"apply", path("m"), path("find"), "-o", path("one"), "--formats", "csv,laz"}), 2);
}

/// Writes the points of a scene and their labels as LAS, with the label as classification or as attribute.
void writeLas(const std::string& csv, const std::string& path, bool has_attribute, const Eigen::Vector3d& shift) {
  const auto columns = urban_nav_core::readCloudColumns(csv, {"x", "y", "z", "label"});
  std::vector<urban_nav_core::LasAttribute> attributes;
  if (has_attribute) attributes.push_back({"label", urban_nav_core::LasAttribute::Type::UChar, ""});
  urban_nav_core::LasWriter writer(path, attributes, "");
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    urban_nav_core::LasPoint point;
    point.p = Eigen::Vector3d((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]) + shift;
    const auto label = static_cast<std::uint8_t>((*columns[3])[i]);
    if (!has_attribute) point.classification = label;
    writer.append(point, has_attribute ? std::string(1, static_cast<char>(label)) : "");
  }
  writer.commit();
}

TEST_F(Labels, LasScenesFarFromTheOriginAreTrainedOnAndLabelledLikeOthers) {
  writeScene("train", "a", 1);
  writeScene("train", "b", 2);
  writeScene("find", "c", 3);
  writeClasses();
  std::filesystem::create_directories(path("las"));
  const Eigen::Vector3d utm(456'000.0, 5'428'000.0, 110.0);
  writeLas(path("train/a_points.csv"), path("las/a.las"), true, utm);
  writeLas(path("train/b_points.csv"), path("las/b.las"), false, utm);
  ASSERT_EQ(train("m", {path("las")}), 0);
  writeLas(path("find/c_points.csv"), path("c.las"), false, utm);
  ASSERT_EQ(labels({"apply", path("m"), path("c.las"), "-o", path("out")}), 0);
  const auto found = readLabelColumns(path("out/c_labels.las")), in_ply = readLabelColumns(path("out/c_labels.ply"));
  int right = 0;
  for (std::size_t i = 0; i < 3000; ++i) {
    right += (*found[0])[i] == (i % 2 == 0 ? 2 : 8) ? 1 : 0;
    ASSERT_NEAR((*found[3])[i], (*in_ply[3])[i], 1e-4) << "northing";
    ASSERT_GT((*found[3])[i], 5'427'999.0);
  }
  EXPECT_GT(right, 2800);
}

TEST_F(Labels, ClassificationsOfLasAreNoNumbersOfClasses) {
  writeScene("train", "a", 1);
  writeScene("train", "b", 2);
  writeClasses();
  writeLas(path("train/a_points.csv"), path("a.las"), false, Eigen::Vector3d::Zero());
  ASSERT_EQ(train("m", {path("train")}), 0);
  EXPECT_EQ(labels({"evaluate", path("m"), path("a.las")}), 2);
  EXPECT_EQ(labels({"evaluate", path("m"), path("a.las"), "--classes", path("classes.csv")}), 0);
}

TEST_F(Labels, OfPublicDataSetsAreGivenByName) {
  writeScene("train", "a", 1);
  writeScene("train", "b", 2);
  EXPECT_EQ(labels({"train", path("train"), "-o", path("m"), "--classes", "semantickitti"}), 0);  // 20: a vehicle
  EXPECT_EQ(labels({"evaluate", path("m"), path("train"), "--classes", "semantickitti"}), 0);
  EXPECT_EQ(labels({"evaluate", path("m"), path("train"), "--classes", "nuscenes"}), 0);  // 20 and 30 exist
  EXPECT_EQ(labels({"evaluate", path("m"), path("train"), "--classes", "semantic-kitti"}), 2);
}

TEST_F(Labels, TrainingGivesTheSameBytesForAnyOrderOfSourcesAndThreads) {
  writeScene("one", "a", 1);
  writeScene("two", "b", 2);
  writeClasses();
  ASSERT_EQ(train("m", {path("one"), path("two"), "--threads", "1"}), 0);
  ASSERT_EQ(train("n", {path("two"), path("one"), "--threads", "2"}), 0);
  EXPECT_EQ(urban_nav_input::testing::readFile(path("m")), urban_nav_input::testing::readFile(path("n")));
}

TEST_F(Labels, RefuseWhatTheyCannotUse) {
  writeScene("train", "a", 1);
  std::filesystem::create_directories(path("empty"));
  writeClasses();
  EXPECT_EQ(labels({"train", path("train"), "-o", path("m")}), 2);  // 20 and 30 are no classes
  EXPECT_EQ(labels({"train", path("empty"), "-o", path("m")}), 2);
  EXPECT_EQ(train("m", {path("train"), path("train")}), 2);  // twice
  EXPECT_FALSE(std::filesystem::exists(path("m")));
  ASSERT_EQ(train("m", {path("train")}), 0);
  EXPECT_EQ(labels({"apply", path("absent.model"), path("train"), "-o", path("out")}), 2);
  EXPECT_EQ(labels({"apply", "default", path("train"), "-o", path("out")}), 0);
  EXPECT_EQ(labels({"apply", path("absent"), path("train"), "-o", path("out")}), 2);
  urban_nav_input::testing::writeFile(path("broken"), urban_nav_input::testing::readFile(path("m")).substr(0, 200));
  EXPECT_EQ(labels({"apply", path("broken"), path("train"), "-o", path("out")}), 2);
  urban_nav_input::testing::writeFile(path("train/a.png"), "an image without a projection.txt");
  EXPECT_EQ(labels({"apply", path("m"), path("train"), "-o", path("out")}), 2);
}

TEST_F(Labels, OfTheDefaultModelAreThoseOfItsModelOfCloudsExceptForMapsOfSideLasers) {
  const auto classesOf = [&](const std::string& name, const std::string& laser) {
    std::string text = "x,y,z,laser,coloured\n";
    for (int i = 0; i < 900; ++i)
      text += std::to_string(0.1 * (i % 30)) + "," + std::to_string(0.1 * (i / 30)) + ",0," + laser + ",0\n";
    urban_nav_input::testing::writeFile(path(name + "_points.csv"), text);
    EXPECT_EQ(labels({"apply", "default", path(name + "_points.csv"), "-o", path("out")}), 0);
    const auto header = urban_nav_core::CsvTable::read(path("out/" + name + "_labels.csv")).header();
    return std::count(header.begin(), header.end(), "p_wall") == 1 ? "one wall" : "two walls";
  };
  EXPECT_STREQ(classesOf("lidar", "32"), "one wall");
  EXPECT_STREQ(classesOf("side", "0"), "two walls");
}

TEST_F(Labels, ClassFilesNameEveryLabel) {
  urban_nav_input::testing::writeFile(path("c.csv"), "id,class\n4,wall\n9,ignore\n");
  const ClassMap map(path("c.csv"));
  EXPECT_EQ(map.toClasses({9, 4}, "p"), (std::vector<SceneClass>{SceneClass::None, SceneClass::Wall}));
  EXPECT_THROW(map.toClasses({4, 5}, "p"), urban_nav_core::UserError);
  for (const char* text : {"id,class\n4,walls\n", "id,class\n4,wall\n4,wall\n", "id\n4\n", "id,class\nx,wall\n"}) {
    urban_nav_input::testing::writeFile(path("c.csv"), text);
    EXPECT_THROW(ClassMap(path("c.csv")), urban_nav_core::UserError) << text;
  }
}

TEST(LabelScores, CountMissingAnswersAsWrongAndWallsAsOneClass) {
  scene_labeler::SceneLabels labels;
  labels.classes = {SceneClass::Paved, SceneClass::SmoothWall};
  labels.labels = {SceneClass::Paved, SceneClass::SmoothWall, SceneClass::None, SceneClass::Paved, SceneClass::Paved};
  labels.probabilities = {0.8F, 0.2F, 0.1F, 0.9F, 0, 0, 0.6F, 0.4F, 1, 0};
  labels.unsure = {0, 0, 1, 0, 0};
  labels.patches = {0, 1, 1, 2, 3};
  LabelScore score(true);
  score.add(labels,
            {SceneClass::Paved, SceneClass::Wall, SceneClass::Wall, SceneClass::TexturedWall, SceneClass::None});
  EXPECT_EQ(score.points(), 4u);
  EXPECT_DOUBLE_EQ(score.accuracy(), 0.5);
  // paved: precision 1/2, recall 1; wall: precision 1, recall 1/3
  EXPECT_NEAR(score.meanF1(), 0.5 * (2.0 / 3.0 + 0.5), 1e-12);
  EXPECT_NEAR(score.calibrationError(), (0.2 + 0.1 + 0.6) / 3.0, 1e-6);
}

/// Writes eight seconds of a drive of two lasers, without cameras; returns the path of the bag.
std::string cutLasers(const std::string& bag, double begin) {
  testing::cutSharedDrive(bag, {begin, begin + 8.0, {"/laser_"}, ""});
  return bag;
}

/// Returns the points of the valid beams of a scan, with their intensities and times.
sensor_msgs::PointCloud2 toCloud(const sensor_msgs::LaserScan& scan) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = scan.header;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(5, "x", 1, sensor_msgs::PointField::FLOAT32, "y", 1, sensor_msgs::PointField::FLOAT32,
                                "z", 1, sensor_msgs::PointField::FLOAT32, "intensity", 1,
                                sensor_msgs::PointField::FLOAT32, "time", 1, sensor_msgs::PointField::FLOAT32);
  std::vector<std::size_t> valid;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    if (scan.ranges[i] > scan.range_min && scan.ranges[i] < scan.range_max) valid.push_back(i);
  modifier.resize(valid.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), intensity(cloud, "intensity"), time(cloud, "time");
  for (const std::size_t i : valid) {
    const float angle = scan.angle_min + static_cast<float>(i) * scan.angle_increment;
    x[0] = scan.ranges[i] * std::cos(angle), x[1] = scan.ranges[i] * std::sin(angle), x[2] = 0.0F;
    *intensity = i < scan.intensities.size() ? scan.intensities[i] : 0.0F;
    *time = static_cast<float>(i) * scan.time_increment;
    ++x, ++intensity, ++time;
  }
  return cloud;
}

/// Writes a bag whose lasers publish points in place of ranges.
void writeWithClouds(const std::string& from, const std::string& to) {
  rosbag::Bag in(from, rosbag::bagmode::Read), out(to, rosbag::bagmode::Write);
  for (const rosbag::MessageInstance& message : rosbag::View(in)) {
    const auto scan = message.instantiate<sensor_msgs::LaserScan>();
    if (!scan) out.write(message.getTopic(), message.getTime(), message);
    else out.write(message.getTopic() + "_cloud", message.getTime(), toCloud(*scan));
  }
}

TEST_F(Labels, OfABagAreThoseOfItsReturnsWhateverItsTruth) {
  const std::string one = cutLasers(path("one.bag"), 0.0), two = cutLasers(path("two.bag"), 16.0);
  const std::string pose_one = path("one.truth/trajectory.tum"), pose_two = path("two.truth/trajectory.tum");
  ASSERT_EQ(labels({"train", two, one, "--trajectory", pose_two, "--trajectory", pose_one, "-o", path("m"), "--set",
                    "scene_labeler.samples=300"}),
            0);
  ASSERT_EQ(labels({"train", one, two, "--trajectory", pose_one, "--trajectory", pose_two, "-o", path("again"), "--set",
                    "scene_labeler.samples=300", "--threads", "1"}),
            0);
  EXPECT_EQ(urban_nav_input::testing::readFile(path("m")), urban_nav_input::testing::readFile(path("again")));
  ASSERT_EQ(labels({"train", one, two, "--trajectory", pose_one, "--trajectory", pose_two, "-o", path("fewer"), "--set",
                    "scene_labeler.samples=200"}),
            0);
  EXPECT_NE(urban_nav_input::testing::readFile(path("m")), urban_nav_input::testing::readFile(path("fewer")));
  std::filesystem::rename(path("two.truth/trajectory.tum"), path("two.tum"));
  std::filesystem::remove_all(path("two.truth"));
  ASSERT_EQ(labels({"apply", path("m"), two, "--trajectory", path("two.tum"), "-o", path("out")}), 0);
  const auto table = urban_nav_core::CsvTable::read(path("out/laser_left_labels.csv"));
  EXPECT_EQ(table.header().front(), "stamp_ns");
  EXPECT_EQ(table.header()[1], "beam");
  EXPECT_EQ(table.header().back(), "unsure");
  EXPECT_GT(table.rows(), 20000u);
  writeWithClouds(two, path("clouds.bag"));
  ASSERT_EQ(labels({"apply", path("m"), path("clouds.bag"), "--trajectory", path("two.tum"), "-o", path("clouds")}), 0);
  const auto of_clouds = urban_nav_core::CsvTable::read(path("clouds/laser_left_labels.csv"));
  ASSERT_EQ(of_clouds.rows(), table.rows());
  std::size_t equal = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) equal += table.text(i, 2) == of_clouds.text(i, 2) ? 1 : 0;
  EXPECT_GT(equal, table.rows() - table.rows() / 100) << "points in single precision";
  EXPECT_EQ(labels({"apply", path("m"), two, "-o", path("none")}), 2) << "neither stereo images nor tf";
  EXPECT_EQ(labels({"evaluate", path("m"), two, "--trajectory", path("two.tum")}), 2) << "no truth";
  ASSERT_EQ(labels({"evaluate", path("m"), one, "--trajectory", pose_one, "--json", path("j")}), 0);
  EXPECT_NE(urban_nav_input::testing::readFile(path("j")).find("\"shape\""), std::string::npos);
  EXPECT_EQ(urban_nav_input::testing::readFile(path("j")).find("\"look\""), std::string::npos);
  const auto teach = [&](const std::string& row) {
    urban_nav_input::testing::writeFile(path("clicks.csv"), "bag,side,stamp_ns,beam,class,trajectory\n" + row + "\n");
    return labels({"train", "--add", path("m"), "--corrections", path("clicks.csv"), "-o", path("taught")});
  };
  EXPECT_EQ(teach("two.bag,left," + table.text(1000, 0) + "," + table.text(1000, 1) + ",foliage,two.tum"), 0);
  EXPECT_EQ(teach("two.bag,left,17," + table.text(1000, 1) + ",foliage,two.tum"), 2) << "no such scan";
  EXPECT_EQ(teach("three.bag,left," + table.text(1000, 0) + ",5,foliage,two.tum"), 2) << "no such bag";
}

}  // namespace
}  // namespace urban_nav
