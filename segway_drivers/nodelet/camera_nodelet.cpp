// SPDX-License-Identifier: BSD-3-Clause
#include "camera_nodelet.hpp"

#include <sensor_msgs/TimeReference.h>
#include <urban_nav_msgs/VoStatistics.h>

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "device_parameters.hpp"
#include "live/simulated_session.hpp"
#include "urban_nav_core/io/printable.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kFrameWait = 100'000'000;                                           // ns
constexpr TimeNs kLeastCameraPause = 200'000'000, kMostCameraPause = 2'000'000'000;  // ns

}  // namespace

CameraNodelet::~CameraNodelet() { shutDown(); }

void CameraNodelet::shutDown() {
  stop_ = true;
  odometry_.shutdown();
  diagnostics_.stop();
  if (reader_.joinable()) reader_.join();
}

bool CameraNodelet::isSimulated() const {
  return nodelet_.port.find('/') != std::string::npos || std::filesystem::exists(nodelet_.port);
}

void CameraNodelet::onInit() {
  try {
    std::tie(nodelet_, parameters_) = readDeviceParameters(getPrivateNodeHandle(), device());
    prepare();
    std::string error;
    source_ = makeSource(error);
    if (source_) {
      makeCamera(*source_);
    } else {
      NODELET_WARN("%s", error.c_str());
      setState(DriverState::Absent, error);
    }
  } catch (const urban_nav_core::Error& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  time_reference_ = getNodeHandle().advertise<sensor_msgs::TimeReference>(device() + "/time_reference", 100);
  diagnostics_.start(getNodeHandle(), getPrivateNodeHandle(), getName(), model() + " " + nodelet_.port, nodelet_.port,
                     [this](DeviceDiagnostics::Status& status) { addDiagnostics(status); });
  if (source_) reader_ = urban_nav_core::namedThread("camera_read", [this] { run(); });
}

std::unique_ptr<FrameSource> CameraNodelet::makeSource(std::string& error) {
  if (!isSimulated()) return makeBusCamera(nodelet_.port, model(), error);
  try {
    FrameReader read = readBag(nodelet_.port);
    if (!nodelet_.paced_by.empty()) read = pace(std::move(read));
    return std::make_unique<SimSource>(std::move(read), simulatedCameraOptions(nodelet_, simulatedModel()),
                                       realSimClock());
  } catch (const urban_nav_core::UserError& no_pictures) {
    error = no_pictures.what();
    return nullptr;
  }
}

/// Delays frames for odometry if its statistics are published.
FrameReader CameraNodelet::pace(FrameReader read) {
  odometry_ = getMTNodeHandle().subscribe<urban_nav_msgs::VoStatistics>(
      nodelet_.paced_by, 100, [this](const urban_nav_msgs::VoStatisticsConstPtr& message) {
        pacer_.answered(static_cast<TimeNs>(message->header.stamp.toNSec()));
      });
  return pacer_.pace(
      std::move(read), [this] { return !stop_ && odometry_.getNumPublishers() == 0; }, stop_);
}

void CameraNodelet::run() {
  TimeNs wait = kLeastCameraPause;
  while (!stop_ && !source_->isFinished()) {
    std::string error;
    if (!start(error)) {
      setState(openings_ == 0 ? DriverState::Absent : DriverState::Lost, error);
      pause(wait);
      wait = std::min(wait + kLeastCameraPause, kMostCameraPause);
      continue;
    }
    wait = kLeastCameraPause;
    setState(DriverState::Configuring, "");
    stream(*source_);
    source_->stop();
    pause(wait);
  }
  if (!stop_) setState(DriverState::Lost, "the recording has ended");
}

/// Runs until the camera disappears or its stream stalls. It is streaming from its first frame on.
void CameraNodelet::stream(FrameSource& source) {
  TimeNs last = steadyTime();
  bool streams = false;
  while (!stop_ && !source.isGone() && !source.isFinished() && steadyTime() - last < stalledAfter()) {
    const std::int64_t frames = counters().frames;
    step(kFrameWait);
    if (counters().frames != frames) {
      last = steadyTime();
      if (!std::exchange(streams, true)) ++openings_;
    }
    if (const TimeNs change = clock_.follow(); change != 0)
      NODELET_WARN("the host clock stepped by %lld ms", static_cast<long long>(change / 1'000'000));
    for (const DriverEvent& event : takeEvents()) NODELET_WARN("%s", urban_nav_core::printable(event.text).c_str());
    setState(streams ? DriverState::Streaming : DriverState::Configuring, "");
  }
  if (!stop_ && !source.isFinished()) setState(source.isGone() ? DriverState::Lost : DriverState::Stalled, "no image");
}

void CameraNodelet::pause(TimeNs duration) const {
  for (const TimeNs end = steadyTime() + duration; !stop_ && steadyTime() < end;) ros::WallDuration(0.05).sleep();
}

ros::Time CameraNodelet::toRos(TimeNs steady) const { return urban_nav_ros::toRosTime(clock_.toReal(steady)); }

void CameraNodelet::publishTimeReference(const std::string& frame, TimeNs arrival, double bus_s) const {
  sensor_msgs::TimeReference reference;
  reference.header.stamp = toRos(arrival);
  reference.header.frame_id = frame;
  reference.time_ref = urban_nav_ros::toRosTime(static_cast<TimeNs>(1e9 * bus_s));
  reference.source = device();
  time_reference_.publish(reference);
}

void CameraNodelet::setState(DriverState state, const std::string& reason) {
  DeviceSnapshot snapshot;
  snapshot.state = state;
  snapshot.reason = reason;
  if (source_) {
    snapshot.identity = identity();
    snapshot.counters = counters();
  }
  snapshot.counters.reconnections = std::max(openings_ - 1, 0);
  if (state != diagnostics_.get().state)
    NODELET_INFO("%s: %s", toString(state),
                 urban_nav_core::printable(reason.empty() ? snapshot.identity : reason).c_str());
  diagnostics_.set(std::move(snapshot));
}

}  // namespace segway_drivers
