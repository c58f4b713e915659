// SPDX-License-Identifier: BSD-3-Clause
#include "support/shared_drive.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <stdio.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "simulate/calibration_errors.hpp"

namespace urban_nav::testing {

namespace {

/// Returns the path of the bag.
std::string recordSharedDrive() {
  const std::string program = (std::filesystem::canonical("/proc/self/exe").parent_path() / "urban_nav").string();
  FILE* const output = ::popen(("python3 test/support/drive.py '" + program + "'").c_str(), "r");
  if (output == nullptr) throw std::runtime_error("no process for test/support/drive.py");
  std::string path;
  for (int c = ::fgetc(output); c != EOF && c != '\n'; c = ::fgetc(output)) path += static_cast<char>(c);
  if (::pclose(output) != 0) throw std::runtime_error("test/support/drive.py failed");
  return path;
}

void copyTruth(const std::string& drive, const std::string& to) {
  const std::filesystem::path from = std::filesystem::path(drive).replace_extension(".truth"),
                              folder = std::filesystem::path(to).replace_extension(".truth");
  std::filesystem::create_directories(folder);
  for (const char* file : {"trajectory.tum", "laser_left.csv", "laser_right.csv"})
    std::filesystem::copy_file(from / file, folder / file);
}

/// Writes a message with a later header stamp if it is of type Message; returns whether it is.
template <typename Message>
bool writeLater(const rosbag::MessageInstance& message, int days, rosbag::Bag& target) {
  const auto original = message.instantiate<Message>();
  if (original == nullptr) return false;
  Message later = *original;
  later.header.stamp += ros::Duration(86400.0 * days);
  target.write(message.getTopic(), message.getTime(), later);
  return true;
}

void writeLater(const rosbag::MessageInstance& message, int days, rosbag::Bag& target) {
  const bool is_written = writeLater<sensor_msgs::Image>(message, days, target) ||
                          writeLater<sensor_msgs::CompressedImage>(message, days, target) ||
                          writeLater<sensor_msgs::CameraInfo>(message, days, target) ||
                          writeLater<sensor_msgs::LaserScan>(message, days, target) ||
                          writeLater<sensor_msgs::Imu>(message, days, target) ||
                          writeLater<sensor_msgs::MagneticField>(message, days, target);
  if (!is_written) throw std::runtime_error(message.getTopic() + " has no header that is known");
}

}  // namespace

void cutSharedDrive(const std::string& to, const DrivePart& part) {
  const CalibrationErrors errors = parseCalibrationErrors(
      {}, part.misplaced.empty() ? std::vector<std::string>{} : std::vector<std::string>{part.misplaced}, {});
  const std::string drive = recordSharedDrive();
  const rosbag::Bag source(drive);
  rosbag::Bag target(to, rosbag::bagmode::Write);
  rosbag::View whole(source);
  const ros::Time start = whole.getBeginTime(), begin = start + ros::Duration(part.begin);
  const auto is_wanted = [&](const std::string& topic) {
    return std::any_of(part.topics.begin(), part.topics.end(),
                       [&](const std::string& name) { return topic.rfind(name, 0) == 0; });
  };
  rosbag::View fixed(source, rosbag::TopicQuery("/tf_static"));
  for (const rosbag::MessageInstance& message : fixed) {
    tf2_msgs::TFMessage transforms = *message.instantiate<tf2_msgs::TFMessage>();
    errors.apply(transforms.transforms);
    target.write("/tf_static", begin, transforms);
  }
  rosbag::View view(source, begin, start + ros::Duration(part.end) - ros::Duration(0, 1));
  for (const rosbag::MessageInstance& message : view) {
    if (!is_wanted(message.getTopic())) continue;
    if (part.days != 0) writeLater(message, part.days, target);
    else target.write(message.getTopic(), message.getTime(), message);
  }
  copyTruth(drive, to);
}

}  // namespace urban_nav::testing
