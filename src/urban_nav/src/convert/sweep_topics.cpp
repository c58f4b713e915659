// SPDX-License-Identifier: BSD-3-Clause
#include "convert/sweep_topics.hpp"

#include <sensor_msgs/PointCloud2.h>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/cloud_view.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;

KittiSweepTopic::KittiSweepTopic(const std::string& folder, double rate) {
  const auto layout = urban_nav_input::findKittiSweeps(folder);
  if (!layout) return;
  T_camera_lidar_ = urban_nav_input::readKittiLidar(folder);
  if (!T_camera_lidar_) return;  // a note of the source
  is_deskewed_ = layout->is_deskewed;
  std::vector<std::string> same_as_source;
  files_ = urban_nav_input::stampKittiSweeps(*layout, rate, same_as_source);
  if (is_deskewed_)
    notes_.push_back(layout->name +
                     ": the data set has deskewed the sweeps, which a bag does not state; read it with "
                     "--set input.points_deskewed=yes");
}

void KittiSweepTopic::writeUntil(StampNs stamp, StampNs shift, BagWriter& bag) {
  for (; next_ < files_.size() && files_[next_].first <= stamp; ++next_) {
    const auto& [at, path] = files_[next_];
    const urban_nav_input::KittiCloud cloud(path, at + shift);
    if (!cloud.fault().empty()) throw urban_nav_core::DataError("", cloud.fault(), "");
    urban_nav_core::CloudView view = cloud.view(is_deskewed_);
    for (urban_nav_core::CloudField& field : view.fields)
      if (field.name == "azimuth") field.name = "time";  // s, as drivers name it; derived from the azimuth
    bag.write(urban_nav_ros::topics::fromRoot(urban_nav_ros::topics::kPoints), at + shift,
              urban_nav_ros::toCloudMessage(view, frame()));
  }
}

}  // namespace urban_nav
