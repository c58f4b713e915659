// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <urban_nav_msgs/StageStatus.h>

#include <mutex>
#include <string>

#include "judge.hpp"
#include "urban_nav_core/types/status.hpp"

namespace loop_metric {

/// What is wrong with the stage as a whole. Numbers are part of the messages: new ones go to the end.
enum class Trouble {
  None = 0,
  NoOdometry = 1,    ///< it has not come, or is silent: candidates wait, then are judged with what is there
  NotStored = 2,     ///< views and scans do not reach the store
  NoCamera = 3,      ///< the two camera_info make no stereo camera
  NoImages = 4,      ///< no views are kept
  NoLasers = 5,      ///< no scans come although clouds may be used
  NoLaserPlace = 6,  ///< scans come, and tf does not tell from where
};
/// "None", "NoOdometry", ...
const char* toString(Trouble trouble);

/// Topics of the stage. Thread-safe.
class Publisher {
 public:
  Publisher(ros::NodeHandle& nh, std::string base_frame);

  /// The verdict, and its picture where somebody looks: the clouds where it rests on them, else the two views.
  void publish(const Judge::Verdict& verdict);
  /// Where it is another one than the last.
  void publish(const urban_nav_core::Status& status);

 private:
  void publishPicture(const Judge::Verdict& verdict);

  const std::string base_frame_;
  ros::Publisher metric_, matches_, status_;
  std::mutex mutex_;  // guards what follows
  urban_nav_msgs::StageStatus last_;
};

}  // namespace loop_metric
