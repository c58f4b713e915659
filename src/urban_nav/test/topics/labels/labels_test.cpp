// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

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
