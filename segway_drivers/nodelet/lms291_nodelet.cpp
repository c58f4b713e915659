// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/LaserScan.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <numeric>

#include "driver_nodelet.hpp"
#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace {

constexpr float kLaserAngleFirst = -0.785398163F, kLaserAngleStep = 0.00872664626F;  // rad; x along beam 90
constexpr double kBeamsPerTurn = 720.0;

}  // namespace

/// Laser: `scan` in the namespace of the laser.
class Lms291Nodelet : public DriverNodelet {
 public:
  ~Lms291Nodelet() override { shutDown(); }

 private:
  std::string device() const override { return "lms291"; }

  std::unique_ptr<DriverCore> makeDriver(const Parameters& parameters) override {
    const std::string space = getNodeHandle().getNamespace();
    frame_ = frameOr(space.size() > 1 ? space.substr(space.rfind('/') + 1) : "laser");
    const LmsDriver::Options options = toLmsOptions(parameters);
    range_max_ = static_cast<float>(options.stream.format.maxRange());
    publisher_ = getNodeHandle().advertise<sensor_msgs::LaserScan>(urban_nav_ros::topics::kScan, 100);
    auto driver = std::make_unique<LmsDriver>(options);
    driver->on_scan = [this](const LmsStampedScan& scan) { take(scan); };
    return driver;
  }

  void take(const LmsStampedScan& scan) {
    publishTimeReference(frame_, scan.arrival, static_cast<double>(scan.count) * kLmsPeriod);
    {
      const std::lock_guard<std::mutex> guard(lock());
      polluted_ = scan.scan.polluted();
      for (std::size_t i = 0; i < codes_.size() && i < scan.scan.codes.size(); ++i) codes_[i] += scan.scan.codes[i];
    }
    if (!scan.stamp) return;
    auto message = boost::make_shared<sensor_msgs::LaserScan>();
    message->header.stamp = toRos(*scan.stamp);
    message->header.frame_id = frame_;
    message->angle_min = kLaserAngleFirst;
    message->angle_increment = kLaserAngleStep;
    message->angle_max = kLaserAngleFirst + kLaserAngleStep * static_cast<float>(scan.scan.ranges.size() - 1);
    message->time_increment = static_cast<float>(kLmsPeriod / kBeamsPerTurn);
    message->scan_time = static_cast<float>(kLmsPeriod);
    message->range_min = 0.05F;
    message->range_max = range_max_;
    message->ranges = scan.scan.ranges;
    message->intensities.assign(scan.scan.reflectivities.begin(), scan.scan.reflectivities.end());
    publish([this, message] { publisher_.publish(message); });
  }

  void addDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    if (polluted_) status.mergeSummary(1, "front window is dirty");
    for (std::size_t i = 1; i < codes_.size(); ++i)
      if (codes_[i] > 0) status.add("beams with code -" + std::to_string(i), codes_[i]);
    codes_.fill(0);
  }

  std::string frame_;
  float range_max_ = 0.0F;
  ros::Publisher publisher_;
  bool polluted_ = false;
  std::array<std::int64_t, 10> codes_{};  // since the last diagnostics
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::Lms291Nodelet, nodelet::Nodelet)
