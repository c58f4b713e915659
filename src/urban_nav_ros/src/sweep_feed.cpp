// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/sweep_feed.hpp"

#include <utility>

#include "urban_nav_ros/cloud_view.hpp"

namespace urban_nav_ros {

SweepFeed::SweepFeed(urban_nav_core::CloudOptions options) : options_(std::move(options)), survey_(options_) {}

std::vector<urban_nav_core::ReadSweep> SweepFeed::add(const sensor_msgs::PointCloud2ConstPtr& message) {
  std::vector<urban_nav_core::ReadSweep> sweeps;
  if (!fault_.empty()) return sweeps;
  if (reader_) {
    sweeps.push_back(reader_->read(toCloudView(*message)));
    return sweeps;
  }
  survey_.add(toCloudView(*message));
  planar_survey_.add(toCloudView(*message));
  waiting_.push_back(message);
  if (waiting_.size() > kMostWaiting) waiting_.erase(waiting_.begin());
  if (!survey_.isComplete()) return sweeps;
  if (planar_survey_.conclude()) {
    fault_ =
        "the points of the clouds lie in one plane: this is a planar laser, not a 3D LiDAR; publish its scans as "
        "sensor_msgs/LaserScan on laser_left/scan or laser_right/scan (pointcloud_to_laserscan makes them), or on scan "
        "for odometry";
    waiting_.clear();
    return sweeps;
  }
  reader_.emplace(survey_.conclude(), options_);
  for (const sensor_msgs::PointCloud2ConstPtr& each : waiting_) sweeps.push_back(reader_->read(toCloudView(*each)));
  waiting_.clear();
  return sweeps;
}

std::optional<urban_nav_core::CloudConvention> SweepFeed::convention() const {
  return reader_ ? std::optional<urban_nav_core::CloudConvention>(reader_->convention()) : std::nullopt;
}

}  // namespace urban_nav_ros
