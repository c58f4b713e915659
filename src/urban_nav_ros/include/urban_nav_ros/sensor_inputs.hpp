// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "urban_nav_ros/sensor_corrections.hpp"

namespace urban_nav_ros {

/// Sensor parameters in the namespace `input` beside the nodelets, common to all of them.
struct LiveCorrectionParameters : SensorCorrectionParameters {
  double right_delay;  // ms; used by the rectifying nodelet
  LiveCorrectionParameters();
};
const urban_nav_core::Table<LiveCorrectionParameters>& liveCorrectionTable();

/// Corrects sensor messages, by topic, before a stage reads them: the live counterpart of the corrections in the
/// readers of recordings. The convention of the accelerometer is applied by Accelerometer. Reports laser scans in other
/// units. Thread-safe.
class SensorInputs {
 public:
  SensorInputs() = default;
  explicit SensorInputs(const SensorCorrections& corrections) : corrections_(corrections) {}
  /// Reads the parameters of `nh` + "/input". Throws UserError.
  explicit SensorInputs(const ros::NodeHandle& nh);

  const SensorCorrections& corrections() const { return corrections_; }

  /// Returns the message itself if there is nothing to correct, or a corrected copy; null if its stamp does not exceed
  /// the delay. `topic`: a name of topics.hpp.
  sensor_msgs::ImuConstPtr correct(const std::string& topic, const sensor_msgs::ImuConstPtr& message) const;
  nav_msgs::OdometryConstPtr correct(const std::string& topic, const nav_msgs::OdometryConstPtr& message) const;
  sensor_msgs::NavSatFixConstPtr correct(const std::string& topic, const sensor_msgs::NavSatFixConstPtr& message) const;
  sensor_msgs::LaserScanConstPtr correct(const std::string& topic, const sensor_msgs::LaserScanConstPtr& message) const;
  template <typename Message>
  boost::shared_ptr<const Message> correct(const std::string&, const boost::shared_ptr<const Message>& message) const {
    return message;
  }

  /// Returns a message for each laser whose last scan was in other units, with the parameter that corrects it.
  std::vector<std::string> faults() const;

 private:
  SensorCorrections corrections_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::string> faults_;  // keyed by topic; guarded by mutex_
};

}  // namespace urban_nav_ros
