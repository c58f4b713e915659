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

/// Parameters of sensors in the namespace `input` next to the nodelets, the same for all of them.
struct LiveCorrectionParameters : SensorCorrectionParameters {
  double right_delay;  // ms; of the nodelet that rectifies
  LiveCorrectionParameters();
};
const urban_nav_core::Table<LiveCorrectionParameters>& liveCorrectionTable();

/// Corrects the messages of sensors, by their topics, before a stage reads them: the live counterpart of the readers'
/// corrections of recordings. The convention of the accelerometer is left to Accelerometer. Names laser scans in other
/// units. Thread-safe.
class SensorInputs {
 public:
  SensorInputs() = default;
  explicit SensorInputs(const SensorCorrections& corrections) : corrections_(corrections) {}
  /// Reads the parameters of `nh` + "/input". Throws UserError.
  explicit SensorInputs(const ros::NodeHandle& nh);

  const SensorCorrections& corrections() const { return corrections_; }

  /// Returns the message itself where nothing is to be corrected, or a corrected copy; null if its stamp is not above
  /// the delay. `topic`: a name of topics.hpp.
  sensor_msgs::ImuConstPtr correct(const std::string& topic, const sensor_msgs::ImuConstPtr& message) const;
  nav_msgs::OdometryConstPtr correct(const std::string& topic, const nav_msgs::OdometryConstPtr& message) const;
  sensor_msgs::NavSatFixConstPtr correct(const std::string& topic, const sensor_msgs::NavSatFixConstPtr& message) const;
  sensor_msgs::LaserScanConstPtr correct(const std::string& topic, const sensor_msgs::LaserScanConstPtr& message) const;
  template <typename Message>
  boost::shared_ptr<const Message> correct(const std::string&, const boost::shared_ptr<const Message>& message) const {
    return message;
  }

  /// Returns a sentence for each laser whose last scan was in other units, with the parameter that repairs it.
  std::vector<std::string> faults() const;

 private:
  SensorCorrections corrections_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::string> faults_;  // keyed by topic; guarded by mutex_
};

}  // namespace urban_nav_ros
