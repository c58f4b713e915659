// SPDX-License-Identifier: BSD-3-Clause
#include "driver_nodelet.hpp"

#include <sensor_msgs/TimeReference.h>

#include <tuple>

#include "device_parameters.hpp"
#include "urban_nav_core/io/printable.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kReaderWait = 2'000'000;        // ns
constexpr TimeNs kSnapshotPeriod = 100'000'000;  // ns, between updates of what the diagnostics show
}  // namespace

DriverNodelet::~DriverNodelet() { shutDown(); }

void DriverNodelet::shutDown() {
  stop_ = true;
  queue_.stop();
  diagnostics_.stop();
  if (reader_.joinable()) reader_.join();
  if (publisher_.joinable()) publisher_.join();
}

void DriverNodelet::onInit() {
  try {
    std::tie(nodelet_, parameters_) = readDeviceParameters(getPrivateNodeHandle(), device());
    if (nodelet_.port.empty())
      throw urban_nav_core::UserError(getPrivateNodeHandle().getNamespace() + "/port", "empty",
                                      "a serial port, HOST:PORT of gpsd, or a CAN interface");
    time_reference_ = getNodeHandle().advertise<sensor_msgs::TimeReference>(
        device() == "lms291" ? "time_reference" : device() + "/time_reference", 100);
    driver_ = makeDriver(parameters_);
  } catch (const urban_nav_core::Error& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  diagnostics_.start(getNodeHandle(), getPrivateNodeHandle(), getName(), nodelet_.port, nodelet_.port,
                     [this](DeviceDiagnostics::Status& status) { addRows(status); });
  queue_.setCapacity(static_cast<std::size_t>(nodelet_.queue));
  publisher_ = urban_nav_core::namedThread("driver_publish", [this] { queue_.run(); });
  reader_ = urban_nav_core::namedThread("driver_read", [this] { run(); });
}

void DriverNodelet::run() {
  DriverLoop loop(*driver_, nodelet_.port);
  TimeNs next_snapshot = 0;
  while (!stop_) {
    const TimeNs now = steadyTime();
    beforeStep(now);
    loop.step(kReaderWait);
    if (const TimeNs step = clock_.follow(); step != 0)
      NODELET_WARN("the host clock stepped by %lld ms", static_cast<long long>(step / 1'000'000));
    for (const DriverEvent& event : driver_->takeEvents()) {
      if (!event.warning) NODELET_INFO("%s", urban_nav_core::printable(event.text).c_str());
      if (!event.warning) continue;
      NODELET_WARN("%s", urban_nav_core::printable(event.text).c_str());
      const std::lock_guard<std::mutex> guard(mutex_);
      last_warning_ = event.text;
    }
    if (now < next_snapshot) continue;
    next_snapshot = now + kSnapshotPeriod;
    takeSnapshot(loop.remark());
  }
}

ros::Time DriverNodelet::toRos(TimeNs steady) const { return urban_nav_ros::toRosTime(clock_.toReal(steady)); }

void DriverNodelet::publishTimeReference(const std::string& frame, TimeNs arrival, double device_s) {
  sensor_msgs::TimeReference reference;
  reference.header.stamp = toRos(arrival);
  reference.header.frame_id = frame;
  reference.time_ref = urban_nav_ros::toRosTime(static_cast<TimeNs>(1e9 * device_s));
  reference.source = device();
  publish([this, reference] { time_reference_.publish(reference); });
}

void DriverNodelet::takeSnapshot(const std::string& remark) {
  DeviceSnapshot snapshot;
  snapshot.state = driver_->state();
  snapshot.identity = driver_->identity();
  snapshot.counters = driver_->counters();
  const std::lock_guard<std::mutex> guard(mutex_);
  snapshot.reason = last_warning_;
  diagnostics_.set(std::move(snapshot));
  remark_ = remark;
  if (const ClockFilter* filter = driver_->clock()) {
    has_clock_ = true;
    offset_s_ = filter->offset();
    skew_ppm_ = 1e6 * filter->skew();
    sigma_us_ = 1e6 * filter->sigma();
    excess_ms_ = 1e3 * filter->meanExcess();
  }
}

void DriverNodelet::addRows(DeviceDiagnostics::Status& status) {
  const std::lock_guard<std::mutex> guard(mutex_);
  if (!remark_.empty()) status.add("port remark", remark_);
  if (!last_warning_.empty()) status.add("last warning", last_warning_);
  status.add("messages dropped", queue_.dropped());
  if (has_clock_) {
    status.add("clock offset (s)", offset_s_);
    status.add("clock skew (ppm)", skew_ppm_);
    status.add("clock sigma (us)", sigma_us_);
    status.add("mean delay above the least (ms)", excess_ms_);
  }
  addDiagnostics(status);
}

}  // namespace segway_drivers
