// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "device_diagnostics.hpp"
#include "live/frame_pacer.hpp"
#include "live/nodelet_parameters.hpp"
#include "segway_drivers/camera/bag_pictures.hpp"
#include "segway_drivers/camera/frame_source.hpp"
#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/parameters.hpp"
#include "segway_drivers/transport/host_clock.hpp"

namespace segway_drivers {

/// Nodelet of a camera: one thread opens it, reads frames and publishes; it is reopened after a loss, with pauses that
/// increase to 2 s. The port is a GUID on the bus, or the path of a recording for a simulated camera. Publishes
/// /diagnostics once per second.
class CameraNodelet : public nodelet::Nodelet {
 public:
  ~CameraNodelet() override;

 protected:
  /// Ends the thread. Must be called by the destructor of the derived class, whose members the thread uses.
  void shutDown();
  /// Prefix of the device's rows in the table, such as "bumblebee2".
  virtual std::string device() const = 0;
  /// Prefix of the camera model on the bus.
  virtual std::string model() const = 0;
  /// Advertises topics. Errors are fatal.
  virtual void prepare() = 0;
  virtual FrameReader readBag(const std::string& bag) = 0;
  virtual SimCameraOptions::Model simulatedModel() const = 0;
  /// Makes the driver of the camera on a source that outlives it.
  virtual void makeCamera(FrameSource& source) = 0;
  virtual bool start(std::string& error) = 0;
  /// Waits up to `wait` ns for a frame and publishes it.
  virtual void step(TimeNs wait) = 0;
  /// Returns the time without frames after which the stream is stalled, ns.
  virtual TimeNs stalledAfter() const = 0;
  virtual const std::string& identity() const = 0;
  virtual const DeviceCounters& counters() const = 0;
  virtual std::vector<DriverEvent> takeEvents() = 0;
  virtual void addDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& /*status*/) {}

  const NodeletParameters& nodelet() const { return nodelet_; }
  const Parameters& parameters() const { return parameters_; }
  bool isSimulated() const;
  ros::Time toRos(TimeNs steady) const;
  /// Reports a published frame with this stamp.
  void countFrame(TimeNs stamp) { pacer_.sent(static_cast<TimeNs>(toRos(stamp).toNSec()), steadyTime()); }
  /// Publishes raw arrival and bus time on time_reference.
  void publishTimeReference(const std::string& frame, TimeNs arrival, double bus_s) const;

 private:
  void onInit() final;
  std::unique_ptr<FrameSource> makeSource(std::string& error);
  FrameReader pace(FrameReader read);
  void run();
  void stream(FrameSource& source);
  void setState(DriverState state, const std::string& reason);
  void pause(TimeNs duration) const;

  NodeletParameters nodelet_;
  Parameters parameters_;
  HostClock clock_;
  ros::Publisher time_reference_;
  std::unique_ptr<FrameSource> source_;
  FramePacer pacer_;
  ros::Subscriber odometry_;  // sets the pace of the camera
  DeviceDiagnostics diagnostics_;
  std::thread reader_;
  std::atomic<bool> stop_{false};
  int openings_ = 0;  // accessed by the reading thread
};

}  // namespace segway_drivers
