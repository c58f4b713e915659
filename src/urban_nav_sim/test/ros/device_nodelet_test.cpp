// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <sensor_msgs/NavSatFix.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>
#include <string>

namespace urban_nav_sim::test {
namespace {

/// A receiver in the manager of nodelet.test, fed by a bag of fixes.
class DeviceNodelet : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    rosbag::Bag bag(bag_, rosbag::bagmode::Write);
    for (int second = 0; second < 60; ++second) {
      sensor_msgs::NavSatFix fix;
      fix.header.stamp = ros::Time(1'225'000'000 + static_cast<unsigned>(second), 0);
      fix.latitude = 51.75;
      fix.longitude = -1.25;
      fix.altitude = 70.0;
      bag.write("gps/fix", fix.header.stamp, fix);
    }
    bag.close();
    ros::param::set("/receiver/kind", "gps");
    ros::param::set("/receiver/bag", bag_);
    ros::param::set("/receiver/link", link_);
  }
  void TearDown() override {
    unload();
    ros::param::del("/receiver");
    std::filesystem::remove_all(folder_);
  }

  static bool load() {
    nodelet::NodeletLoad call;
    call.request.name = "/receiver";
    call.request.type = "urban_nav_sim/DeviceNodelet";
    return ros::service::waitForService("/device_manager/load_nodelet", ros::Duration(20.0)) &&
           ros::service::call("/device_manager/load_nodelet", call) && call.response.success;
  }
  static void unload() {
    nodelet::NodeletUnload call;
    call.request.name = "/receiver";
    ros::service::call("/device_manager/unload_nodelet", call);
  }

  static bool until(const std::function<bool()>& so) {
    for (int i = 0; i < 2000 && ros::ok(); ++i) {
      if (so()) return true;
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }
  bool isThere() const { return std::filesystem::is_symlink(link_); }

  /// Reads at 9 600 baud until the text is there; returns what was read.
  std::string readUntil(const std::string& text) const {
    const int port = ::open(link_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    termios settings{};
    tcgetattr(port, &settings);
    cfmakeraw(&settings);
    cfsetspeed(&settings, B9600);
    tcsetattr(port, TCSANOW, &settings);
    std::string read;
    until([&] {
      std::array<char, 256> buffer;
      const ssize_t count = ::read(port, buffer.data(), buffer.size());
      if (count > 0) read.append(buffer.data(), static_cast<std::size_t>(count));
      return read.find(text) != std::string::npos;
    });
    ::close(port);
    return read;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("device_nodelet_" + std::to_string(::getpid()));
  const std::string bag_ = (folder_ / "session.bag").string(), link_ = (folder_ / "ports" / "gps").string();
};

TEST_F(DeviceNodelet, MeasuresWhatIsInTheBagAtItsPort) {
  ASSERT_TRUE(load());
  ASSERT_TRUE(until([this] { return isThere(); }));
  const std::string read = readUntil("5145.00000,N,00115.00000,W");
  EXPECT_NE(read.find("5145.00000,N,00115.00000,W"), std::string::npos) << read;
}

TEST_F(DeviceNodelet, TakesItsPortAwayWhenItIsUnloaded) {
  ASSERT_TRUE(load());
  ASSERT_TRUE(until([this] { return isThere(); }));
  unload();
  EXPECT_FALSE(isThere());
}

TEST_F(DeviceNodelet, AFaultPullsThePlug) {
  ros::param::set("/receiver/fault", "unplug:1:1");
  ASSERT_TRUE(load());
  ASSERT_TRUE(until([this] { return isThere(); }));
  EXPECT_TRUE(until([this] { return !isThere(); }));
  EXPECT_TRUE(until([this] { return isThere(); }));
}

TEST_F(DeviceNodelet, WrongParametersAreRefused) {
  ros::param::set("/receiver/kind", "sonar");
  EXPECT_FALSE(load());
  ros::param::set("/receiver/kind", "gps");
  ros::param::set("/receiver/fault", "melt:1:1");
  EXPECT_FALSE(load());
  ros::param::del("/receiver/fault");
  ros::param::set("/receiver/bag", bag_ + ".absent");
  EXPECT_FALSE(load());
}

}  // namespace
}  // namespace urban_nav_sim::test
