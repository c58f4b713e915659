// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/accelerometer_finding.hpp"

#include "urban_nav_ros/sensor_corrections.hpp"

namespace urban_nav_input {

using urban_nav_core::AccelerometerConvention;
using urban_nav_core::AccelerometerFault;
using urban_nav_core::AccelerometerVerdict;

std::vector<Finding> accelerometerFindings(const std::string& topic, const AccelerometerVerdict& verdict,
                                           const AccelerometerConvention& present) {
  if (verdict.sound()) return {};
  Finding finding{FindingKind::Imu, topic + ": " + verdict.sentence() + "; the accelerometer is not used", ""};
  if (verdict.repair) {
    for (const urban_nav_ros::CorrectionSetting& setting : urban_nav_ros::settingsFor(verdict, present))
      finding.options.insert(finding.options.end(), {"--set", "input." + setting.name + "=" + setting.value});
    for (std::size_t i = 0; i < finding.options.size(); ++i) finding.remedy += (i > 0 ? " " : "") + finding.options[i];
    finding.remedy +=
        "; for later recordings let the driver publish specific force in m/s2 in the axes of its frame, "
        "9.81 upwards at rest";
  } else if (verdict.fault == AccelerometerFault::NoGravity) {
    finding.remedy = "record the topic of the driver that contains gravity (imu/data_raw, not linear acceleration)";
  } else if (verdict.fault == AccelerometerFault::Direction) {
    finding.remedy = "check the pose of the device in /tf_static; --transform PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW sets it";
  } else {
    finding.remedy = "check the driver and the calibration of the device";
  }
  return {finding};
}

}  // namespace urban_nav_input
