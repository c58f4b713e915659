// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include "urban_nav_ros/sweep_feed.hpp"

namespace urban_nav_ros {

/// Converts the clouds of several 3D LiDARs, which are distinguished by the frames of their headers. Not thread-safe.
class SweepFeeds {
 public:
  struct Listener {
    std::function<void(const std::string& frame, const urban_nav_core::Sweep& sweep)> sweep;
    std::function<void()> invalid;  ///< a cloud that no sweep can be read from
  };

  explicit SweepFeeds(Listener listener) : listener_(std::move(listener)) {}

  /// Passes on the sweeps that are ready after a message.
  void add(const sensor_msgs::PointCloud2ConstPtr& message) {
    const std::string& frame = message->header.frame_id;
    for (const urban_nav_core::ReadSweep& read : feeds_[frame].add(message)) {
      if (read.fault.empty()) listener_.sweep(frame, read.sweep);
      else listener_.invalid();
    }
  }
  /// Returns why the clouds of a frame are not used; empty: all are used, or undecided.
  std::string fault() const {
    for (const auto& [frame, feed] : feeds_)
      if (!feed.fault().empty()) return frame + ": " + feed.fault();
    return {};
  }

 private:
  const Listener listener_;
  std::map<std::string, SweepFeed> feeds_;  // by frame
};

}  // namespace urban_nav_ros
