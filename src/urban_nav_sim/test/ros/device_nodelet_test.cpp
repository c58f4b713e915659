// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <sensor_msgs/NavSatFix.h>
#include <sys/inotify.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "urban_nav_ros/testing/listener.hpp"

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
    return ros::service::waitForService("/device_manager/load_nodelet", ros::Duration(-1.0)) &&
           ros::service::call("/device_manager/load_nodelet", call) && call.response.success;
  }
  static void unload() {
    nodelet::NodeletUnload call;
    call.request.name = "/receiver";
    ros::service::call("/device_manager/unload_nodelet", call);
  }

  static bool until(const std::function<bool()>& so) { return urban_nav_ros::testing::Listener::until(so); }
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

/// The system notes what becomes of the port, so that nothing is missed where this process has to wait.
TEST_F(DeviceNodelet, AFaultPullsThePlug) {
  const std::filesystem::path folder = std::filesystem::path(link_).parent_path();
  std::filesystem::create_directories(folder);
  const int changes = ::inotify_init1(IN_NONBLOCK);
  ASSERT_GE(changes, 0);
  ASSERT_GE(::inotify_add_watch(changes, folder.c_str(), IN_CREATE | IN_MOVED_TO | IN_DELETE), 0);
  std::string history;  // of the port: + it comes, - it goes
  const auto readHistory = [&] {
    alignas(inotify_event) std::array<char, 4096> buffer;
    const ssize_t size = ::read(changes, buffer.data(), buffer.size());
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
      if (std::string(event->name) == "gps") history += (event->mask & IN_DELETE) != 0 ? '-' : '+';
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
    }
    return history.find("+-+") != std::string::npos;
  };
  ros::param::set("/receiver/fault", "unplug:1:1");
  ASSERT_TRUE(load());
  EXPECT_TRUE(until(readHistory)) << history;
  ::close(changes);
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
