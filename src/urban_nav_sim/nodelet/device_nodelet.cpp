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
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_sim/ros/bag_readings.hpp"

namespace urban_nav_sim {

/// One simulated device at its port, fed by a bag: the reading of the bag and the device run in a thread of their own,
/// on the steady clock.
class DeviceNodelet : public nodelet::Nodelet {
 public:
  ~DeviceNodelet() override {
    stop_ = true;
    if (worker_.joinable()) worker_.join();
  }

 private:
  void onInit() override;
  void work();

  DeviceParameters parameters_;
  SimulatedDeviceJob job_;
  std::atomic<bool> stop_{false};
  std::thread worker_;
};

void DeviceNodelet::onInit() {
  const ros::NodeHandle& handle = getPrivateNodeHandle();
  try {
    parameters_ = urban_nav_ros::readParameters(handle, deviceTable());
    job_ = simulatedDeviceJob(parameters_, handle.getNamespace() + "/");
  } catch (const urban_nav_core::UserError& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  worker_ = std::thread([this] { work(); });
}

void DeviceNodelet::work() try {
  DeviceReadings readings = readBagReadings(parameters_.bag, parameters_.kind, parameters_.side);
  const std::int64_t measurements = runSimulatedDevice(job_, std::move(readings), [this] { return stop_.load(); });
  NODELET_INFO("%s: the session is over, %ld measurements", parameters_.kind.c_str(), static_cast<long>(measurements));
} catch (const urban_nav_core::Error& error) {
  NODELET_FATAL("%s", error.what());
}

}  // namespace urban_nav_sim

PLUGINLIB_EXPORT_CLASS(urban_nav_sim::DeviceNodelet, nodelet::Nodelet)
