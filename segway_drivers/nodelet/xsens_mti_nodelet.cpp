// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/MagneticField.h>
#include <pluginlib/class_list_macros.hpp>

#include "driver_nodelet.hpp"
#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace {

constexpr double kMtiFieldUnit = 50e-6;  // T: the unit of the device is the field at its calibration

void setVector(const MtiSample::Vector& from, geometry_msgs::Vector3& to) {
  to.x = from[0];
  to.y = from[1];
  to.z = from[2];
}

}  // namespace

/// Inertial unit: publishes `imu/data` in the axes of the sensor, orientation to ENU, and `imu/mag`.
class XsensMtiNodelet : public DriverNodelet {
 public:
  ~XsensMtiNodelet() override { shutDown(); }

 private:
  std::string device() const override { return "xsens_mti"; }

  std::unique_ptr<DriverCore> makeDriver(const Parameters& parameters) override {
    frame_ = frameOr("imu_link");
    motion_ = getNodeHandle().advertise<sensor_msgs::Imu>(urban_nav_ros::topics::kImu, 100);
    field_ = getNodeHandle().advertise<sensor_msgs::MagneticField>(urban_nav_ros::topics::kMagneticField, 100);
    auto driver = std::make_unique<MtiDriver>(toMtiOptions(parameters));
    driver->on_sample = [this](const MtiStampedSample& sample) { take(sample); };
    return driver;
  }

  void take(const MtiStampedSample& sample) {
    const MtiSample& values = sample.sample;
    if (values.sample_time_fine || values.counter)
      publishTimeReference(frame_, sample.arrival,
                           values.sample_time_fine ? 1e-4 * *values.sample_time_fine : 0.01 * *values.counter);
    if (!sample.stamp || !values.acceleration || !values.rate) return;
    sensor_msgs::Imu motion;
    motion.header.stamp = toRos(*sample.stamp);
    motion.header.frame_id = frame_;
    setVector(*values.acceleration, motion.linear_acceleration);
    setVector(*values.rate, motion.angular_velocity);
    motion.orientation.w = 1.0;
    motion.orientation_covariance[0] = -1.0;
    if (const auto q = mtiOrientationEnu(values)) {
      motion.orientation.w = (*q)[0];
      motion.orientation.x = (*q)[1];
      motion.orientation.y = (*q)[2];
      motion.orientation.z = (*q)[3];
      motion.orientation_covariance[0] = 0.0;
    }
    publish([this, motion] { motion_.publish(motion); });
    if (!values.field) return;
    sensor_msgs::MagneticField field;
    field.header = motion.header;
    MtiSample::Vector tesla = *values.field;
    for (double& each : tesla) each *= kMtiFieldUnit;
    setVector(tesla, field.magnetic_field);
    publish([this, field] { field_.publish(field); });
  }

  std::string frame_;
  ros::Publisher motion_, field_;
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::XsensMtiNodelet, nodelet::Nodelet)
