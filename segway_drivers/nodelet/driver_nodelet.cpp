// SPDX-License-Identifier: BSD-3-Clause
#include "driver_nodelet.hpp"

#include <sensor_msgs/TimeReference.h>

#include <tuple>

#include "device_parameters.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs reader_wait = 2'000'000;        // ns
constexpr TimeNs snapshot_period = 100'000'000;  // ns, between updates of what the diagnostics show

}  // namespace

DriverNodelet::~DriverNodelet() { shutDown(); }

void DriverNodelet::shutDown() {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  timer_.stop();
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
  updater_ = std::make_unique<diagnostic_updater::Updater>(getNodeHandle(), getPrivateNodeHandle(), getName());
  updater_->setHardwareID(nodelet_.port);
  updater_->add("driver", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { fill(status); });
  timer_ = getNodeHandle().createWallTimer(ros::WallDuration(1.0),
                                           [this](const ros::WallTimerEvent&) { updater_->force_update(); });
  publisher_ = std::thread([this] { publishQueued(); });
  reader_ = std::thread([this] { run(); });
}

void DriverNodelet::run() {
  DriverLoop loop(*driver_, nodelet_.port);
  TimeNs next_snapshot = 0;
  while (!stop_) {
    const TimeNs now = steadyTime();
    beforeStep(now);
    loop.step(reader_wait);
    if (const TimeNs step = clock_.follow(); step != 0)
      NODELET_WARN("the host's clock stepped by %lld ms", static_cast<long long>(step / 1'000'000));
    for (const DriverEvent& event : driver_->takeEvents()) {
      if (!event.warning) {
        NODELET_INFO("%s", event.text.c_str());
        continue;
      }
      NODELET_WARN("%s", event.text.c_str());
      const std::lock_guard<std::mutex> guard(mutex_);
      last_warning_ = event.text;
    }
    if (now < next_snapshot) continue;
    next_snapshot = now + snapshot_period;
    const std::lock_guard<std::mutex> guard(mutex_);
    counters_ = driver_->counters();
    state_ = driver_->state();
    identity_ = driver_->identity();
    remark_ = loop.remark();
    if (const ClockFilter* filter = driver_->clock()) {
      has_clock_ = true;
      offset_s_ = filter->offset();
      skew_ppm_ = 1e6 * filter->skew();
      sigma_us_ = 1e6 * filter->sigma();
      excess_ms_ = 1e3 * filter->meanExcess();
    }
  }
}

ros::Time DriverNodelet::toRos(TimeNs steady) const { return urban_nav_ros::toRosTime(clock_.toReal(steady)); }

void DriverNodelet::publish(std::function<void()> work) {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (queue_.size() >= static_cast<std::size_t>(nodelet_.queue)) {
      ++dropped_;
      return;
    }
    queue_.push_back(std::move(work));
  }
  wake_.notify_one();
}

void DriverNodelet::publishQueued() {
  while (true) {
    std::function<void()> work;
    {
      std::unique_lock<std::mutex> guard(mutex_);
      wake_.wait(guard, [this] { return stop_ || !queue_.empty(); });
      if (queue_.empty()) return;
      work = std::move(queue_.front());
      queue_.pop_front();
    }
    work();
  }
}

void DriverNodelet::publishTimeReference(const std::string& frame, TimeNs arrival, double device_s) {
  sensor_msgs::TimeReference reference;
  reference.header.stamp = toRos(arrival);
  reference.header.frame_id = frame;
  reference.time_ref = urban_nav_ros::toRosTime(static_cast<TimeNs>(1e9 * device_s));
  reference.source = device();
  publish([this, reference] { time_reference_.publish(reference); });
}

void DriverNodelet::fill(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> guard(mutex_);
  const bool good = state_ == DriverState::Streaming;
  const bool bad = state_ == DriverState::Absent || state_ == DriverState::Lost;
  status.summary(static_cast<unsigned char>(good ? 0 : bad ? 2 : 1), toString(state_));
  status.add("port", nodelet_.port);
  status.add("identity", identity_);
  if (!remark_.empty()) status.add("port remark", remark_);
  if (!last_warning_.empty()) status.add("last warning", last_warning_);
  status.add("bytes", counters_.bytes);
  status.add("frames", counters_.frames);
  status.add("bad checksums", counters_.bad_checksums);
  status.add("bytes skipped", counters_.bytes_skipped);
  status.add("gaps", counters_.gaps);
  status.add("unexpected replies", counters_.unexpected);
  status.add("timeouts", counters_.timeouts);
  status.add("reconnections", counters_.reconnections);
  status.add("messages dropped", dropped_);
  if (has_clock_) {
    status.add("clock offset (s)", offset_s_);
    status.add("clock skew (ppm)", skew_ppm_);
    status.add("clock sigma (us)", sigma_us_);
    status.add("mean delay above the least (ms)", excess_ms_);
    status.add("clock epochs", counters_.epochs);
  }
  addDiagnostics(status);
}

}  // namespace segway_drivers
