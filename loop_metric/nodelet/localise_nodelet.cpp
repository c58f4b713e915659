// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <functional>
#include <tuple>
#include <vector>

#include "initial_pose.hpp"
#include "localise_diagnostics.hpp"
#include "localise_publisher.hpp"
#include "localise_worker.hpp"
#include "subscriptions.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/trigger.hpp"

namespace loop_metric {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

/// Localisation in a map that stays as it is: callbacks enqueue, one thread looks for the robot's views among those of a store.
class LocaliseNodelet : public nodelet::Nodelet {
 public:
  ~LocaliseNodelet() override {
    if (subscriptions_) subscriptions_->end();
    services_.clear();
    timer_.stop();
    worker_.reset();
  }

 private:
  void onInit() override;
  Store openStore() const;
  void begin(Store store);
  void subscribe();
  void advertiseServices();
  void tell();

  Parameters parameters_;
  LocalisationParameters nodelet_;
  HeardTopics topics_;
  std::unique_ptr<Subscriptions> subscriptions_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  std::vector<urban_nav_store::StoredTrajectory> map_;
  std::unique_ptr<LocalisePublisher> publisher_;
  std::unique_ptr<LocaliseDiagnostics> diagnostics_;
  std::unique_ptr<LocaliseWorker> worker_;
  std::atomic<std::int64_t> beliefs_refused_{0};
  std::atomic<bool> paused_{false};
  std::string map_fault_;  // the timer's
};

void LocaliseNodelet::onInit() {
  try {
    std::tie(nodelet_, parameters_) =
        urban_nav_ros::readParameters(getPrivateNodeHandle(), localisationTable(), table());
    begin(openStore());
  } catch (const urban_nav_core::Error& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
}

Store LocaliseNodelet::openStore() const {
  const std::string parameter = getPrivateNodeHandle().resolveName("store");
  if (nodelet_.store.empty() || nodelet_.store.front() != '/')
    throw UserError(parameter, "`" + nodelet_.store + "`", "the absolute path of a session store");
  try {
    return Store(nodelet_.store, Access::Read);
  } catch (const urban_nav_core::Error& error) {
    throw UserError(parameter, error.what(), "");
  }
}

void LocaliseNodelet::begin(Store store) {
  std::optional<FrozenMap> map;
  try {
    map.emplace(store);
  } catch (const urban_nav_core::Error& error) {
    throw UserError(getPrivateNodeHandle().resolveName("store"), error.what(), "");
  }
  ros::NodeHandle& nh = getNodeHandle();
  map_ = map->sessions();
  publisher_ = std::make_unique<LocalisePublisher>(nh, nodelet_);
  publisher_->publish(map_);
  publisher_->publish(Located(), std::nullopt);
  diagnostics_ = std::make_unique<LocaliseDiagnostics>(nh, getPrivateNodeHandle(), getName(), topics_, nodelet_.store);
  const bool rectified = urban_nav_ros::areRectified(nodelet_.images, nh.resolveName("stereo/left/image_raw"));
  worker_ = std::make_unique<LocaliseWorker>(
      parameters_, nodelet_, rectified, nh.resolveName("stereo"), std::move(store), std::move(*map),
      [this](const Located& located, const auto& T_map_odom) { publisher_->publish(located, T_map_odom); });
  subscribe();
  advertiseServices();
  timer_ = nh.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { tell(); });
}

void LocaliseNodelet::subscribe() {
  using Kind = HeardTopics::Kind;
  subscriptions_ = std::make_unique<Subscriptions>(getNodeHandle(), nodelet_.queue, topics_);
  subscriptions_->listenToRobot(true, nodelet_.compressed, *worker_);
  if (parameters_.icp)
    for (const char* name : {"laser_left/scan", "laser_right/scan"})
      subscriptions_->listen<sensor_msgs::LaserScan>(
          name, Kind::Lasers, [this](const sensor_msgs::LaserScanConstPtr& message) { worker_->put(message); });
  subscriptions_->listen<nav_msgs::Odometry>(
      "vo/odometry", Kind::Odometry, [this](const nav_msgs::OdometryConstPtr& message) {
        publisher_->sendTransform(urban_nav_ros::toStampNs(message->header.stamp));
      });
  subscriptions_->listen<geometry_msgs::PoseWithCovarianceStamped>(
      "initialpose", Kind::Beliefs, [this](const geometry_msgs::PoseWithCovarianceStampedConstPtr& message) {
        try {
          worker_->put(LocaliseWorker::Belief{urban_nav_ros::toStampNs(message->header.stamp),
                                              toBelief(*message, nodelet_.map_frame, "initialpose", map_)});
        } catch (const UserError& error) {
          ++beliefs_refused_;
          NODELET_ERROR("%s", error.what());
        }
      });
}

void LocaliseNodelet::advertiseServices() {
  const auto advertise = [this](const char* name, const std::function<std::string()>& action) {
    services_.push_back(urban_nav_ros::advertiseTrigger(getMTPrivateNodeHandle(), name, action));
  };
  advertise("reset", [this] {
    worker_->put(LocaliseWorker::Reset());
    return "where the robot is, is not known any more";
  });
  advertise("pause", [this] {
    paused_ = true;
    subscriptions_->pause(true);
    return "images and scans are dropped until resume; odometry is followed";
  });
  advertise("resume", [this] {
    paused_ = false;
    subscriptions_->pause(false);
    return "views and clouds are looked for again";
  });
}

void LocaliseNodelet::tell() {
  const LocaliseWorker::State worker = worker_->state();
  diagnostics_->worked(worker, {subscriptions_->pausedDropped(), subscriptions_->damaged(), beliefs_refused_, paused_});
  publisher_->publish(diagnostics_->status());
  diagnostics_->update();
  if (worker.map_fault == map_fault_) return;
  map_fault_ = worker.map_fault;
  if (!map_fault_.empty())
    NODELET_ERROR("%s: %s", getPrivateNodeHandle().resolveName("store").c_str(), map_fault_.c_str());
}

}  // namespace loop_metric

PLUGINLIB_EXPORT_CLASS(loop_metric::LocaliseNodelet, nodelet::Nodelet)
