// SPDX-License-Identifier: BSD-3-Clause
// --preset of doctor, on a recording of a Livox without tf: its accelerations are in g.
#include "map/preset_options.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "inspect/inspect.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

constexpr double kLivoxBegin = 1.6e9;  // s
constexpr int kLivoxSweeps = 30, kLivoxPoints = 2000;

/// A room of 8 m around the LiDAR, as the driver's PointCloud2: times in ns, absolute.
sensor_msgs::PointCloud2 livoxSweep(double begin) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ros::Time(begin);
  cloud.header.frame_id = "livox_frame";
  cloud.height = 1;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(5, "x", 1, sensor_msgs::PointField::FLOAT32, "y", 1, sensor_msgs::PointField::FLOAT32,
                                "z", 1, sensor_msgs::PointField::FLOAT32, "intensity", 1,
                                sensor_msgs::PointField::FLOAT32, "timestamp", 1, sensor_msgs::PointField::FLOAT64);
  modifier.resize(kLivoxPoints);
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z"), intensity(cloud, "intensity");
  sensor_msgs::PointCloud2Iterator<double> time(cloud, "timestamp");
  for (int i = 0; i < kLivoxPoints; ++i, ++x, ++y, ++z, ++intensity, ++time) {
    const double azimuth = 0.37 * i, elevation = 0.5 * std::sin(0.11 * i);
    *x = static_cast<float>(8.0 * std::cos(azimuth));
    *y = static_cast<float>(8.0 * std::sin(azimuth));
    *z = static_cast<float>(8.0 * std::tan(elevation));
    *intensity = 50.0F;
    *time = 1e9 * (begin + 0.1 * i / kLivoxPoints);
  }
  return cloud;
}

void writeLivoxBag(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  for (int i = 0; i < kLivoxSweeps; ++i) {
    const double begin = kLivoxBegin + 0.1 * i;
    bag.write("/livox/lidar", ros::Time(begin + 0.11), livoxSweep(begin));
    for (int k = 0; k < 20; ++k) {
      sensor_msgs::Imu imu;
      imu.header.stamp = ros::Time(begin + 0.005 * k);
      imu.header.frame_id = "livox_frame";
      imu.linear_acceleration.z = 1.0;  // g
      bag.write("/livox/imu", ros::Time(begin + 0.005 * k + 0.001), imu);
    }
  }
}

class PresetOptions : public ::testing::Test {
 protected:
  PresetOptions() { writeLivoxBag(bag()); }
  std::string bag() const { return folder_.file("livox.bag"); }
  /// Runs doctor with further arguments; returns its exit status.
  int doctor(std::vector<std::string> words) {
    words.insert(words.begin(), {"urban_nav", "doctor", bag(), "--json", folder_.file("doctor.json")});
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({doctorCommand()}, addStageTables, static_cast<int>(argv.size()), argv.data());
  }
  nlohmann::json result() const {
    return nlohmann::json::parse(urban_nav_input::testing::readFile(folder_.file("doctor.json")));
  }

 private:
  const urban_nav_input::testing::TemporaryFolder folder_;
};

TEST_F(PresetOptions, GiveDoctorTheTopicsAndUnitsOfTheDriver) {
  ASSERT_EQ(doctor({}), 0);
  const std::string before = result()["findings"].dump();
  ASSERT_EQ(doctor({"--preset", "livox"}), 0);
  const nlohmann::json after = result();
  std::map<std::string, std::string> topics;
  for (const nlohmann::json& input : after["inputs"]) topics[input["role"]] = input["topic"];
  EXPECT_EQ(topics["points0"], "/livox/lidar");
  EXPECT_EQ(topics["imu"], "/livox/imu");
  EXPECT_EQ(after["findings"].dump().find("accelerometer_scale"), std::string::npos) << after["findings"].dump(1);
  EXPECT_EQ(after["findings"].dump().find("accelerometer is not used"), std::string::npos);
  EXPECT_NE(before, after["findings"].dump());
}

TEST_F(PresetOptions, OfAnotherDriverAreRefused) {
  EXPECT_EQ(doctor({"--preset", "realsense"}), 1);
  EXPECT_EQ(result()["findings"][0]["kind"], "topics");
  EXPECT_NE(result()["findings"][0]["text"].dump().find("infra2/camera_info"), std::string::npos);
  EXPECT_EQ(doctor({"--preset", "kinect"}), 2);
}

/// Returns the scale of the accelerometer after the presets.
double scaleAfter(const std::map<std::string, std::vector<std::string>>& given) {
  const Arguments arguments(given, addStageTables);
  ParameterSet parameters = loadParameters(arguments);
  setPresetUnits(arguments, parameters);
  return parameters.get(urban_nav_input::inputTable()).accelerometer_scale;
}

TEST(PresetUnits, AreOverriddenByTheUser) {
  EXPECT_DOUBLE_EQ(scaleAfter({}), 1.0);
  EXPECT_DOUBLE_EQ(scaleAfter({{"preset", {"velodyne"}}}), 1.0);
  EXPECT_DOUBLE_EQ(scaleAfter({{"preset", {"velodyne", "livox"}}}), 9.80665);
  EXPECT_DOUBLE_EQ(scaleAfter({{"preset", {"livox"}}, {"set", {"input.accelerometer_scale=1"}}}), 1.0);
}

TEST(PresetUnits, AndTopicsAreInTheHelp) {
  EXPECT_NE(presetHelp(false).find("realsense: "), std::string::npos);
  const std::string help = presetHelp(true);
  for (const char* text : {"realsense: ", ".../infra1/image_rect_raw", "input.accelerometer_scale=9.80665"})
    EXPECT_NE(help.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace urban_nav
