// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>

#include "live/device_parameters.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_sim/ros/bag_readings.hpp"

namespace urban_nav_sim {

/// A simulated device at its port, driven by a bag, in a separate thread on the steady clock. The bag is read before,
/// in the thread of the manager, since rosbag loads plugins, which is not safe while the manager loads nodelets.
class DeviceNodelet : public nodelet::Nodelet {
 public:
  ~DeviceNodelet() override {
    stop_ = true;
    if (worker_.joinable()) worker_.join();
  }

 private:
  void onInit() override;
  void work();

  SimulatedDeviceJob job_;
  DeviceReadings readings_;
  std::atomic<bool> stop_{false};
  std::thread worker_;
};

void DeviceNodelet::onInit() {
  const ros::NodeHandle& handle = getPrivateNodeHandle();
  try {
    const DeviceParameters parameters = urban_nav_ros::readParameters(handle, deviceTable());
    job_ = simulatedDeviceJob(parameters, handle.getNamespace() + "/");
    readings_ = readBagReadings(parameters.bag, parameters.kind, parameters.side);
  } catch (const urban_nav_core::Error& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  worker_ = urban_nav_core::namedThread("device", [this] { work(); });
}

void DeviceNodelet::work() try {
  const std::int64_t measurements = runSimulatedDevice(job_, std::move(readings_), [this] { return stop_.load(); });
  NODELET_INFO("%s: the session is over, %ld measurements", job_.kind.c_str(), static_cast<long>(measurements));
} catch (const urban_nav_core::Error& error) {
  NODELET_FATAL("%s", error.what());
}

}  // namespace urban_nav_sim

PLUGINLIB_EXPORT_CLASS(urban_nav_sim::DeviceNodelet, nodelet::Nodelet)
