// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// A bag that appears whole or not at all (until then it is PATH.active, as rosbag record has it), its chunks not
/// compressed. Messages are to come in the order of their receipt. Throws UserError naming the bag where it cannot be
/// written.
class BagWriter {
 public:
  explicit BagWriter(const std::string& path);
  ~BagWriter();

  template <typename Message>
  void write(const std::string& topic, urban_nav_core::StampNs stamp, const Message& message) {
    writeNow(topic, stamp, message, nullptr);
  }
  /// /tf_static, latched.
  void writeStaticTransforms(urban_nav_core::StampNs stamp,
                             const std::vector<geometry_msgs::TransformStamped>& transforms);

  /// Closes, flushes, renames.
  void commit();
  /// Messages by topic so far.
  const std::map<std::string, std::int64_t>& counts() const { return counts_; }

 private:
  template <typename Message>
  void writeNow(const std::string& topic, urban_nav_core::StampNs stamp, const Message& message,
                const boost::shared_ptr<ros::M_string>& header);
  ros::Time receipt(urban_nav_core::StampNs stamp) const;
  [[noreturn]] void fail(const std::exception& error) const;

  /// The destructor of a bag that cannot be closed (the disk is full) ends the process: such a bag is never destroyed.
  struct Close {
    void operator()(rosbag::Bag* bag) const;
  };

  std::string path_;
  urban_nav_core::PartialFile file_;
  std::unique_ptr<rosbag::Bag, Close> bag_;
  std::map<std::string, std::int64_t> counts_;
};

template <typename Message>
void BagWriter::writeNow(const std::string& topic, urban_nav_core::StampNs stamp, const Message& message,
                         const boost::shared_ptr<ros::M_string>& header) {
  try {
    bag_->write(topic, receipt(stamp), message, header);
    ++counts_[topic];
  } catch (const rosbag::BagException& error) {
    fail(error);
  }
}

}  // namespace urban_nav
