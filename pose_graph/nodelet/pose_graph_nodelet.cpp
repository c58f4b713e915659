// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/RelativeConstraint.h>
#include <urban_nav_msgs/RelativePose.h>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <optional>
#include <tuple>

#include "accelerometer.hpp"
#include "diagnostics.hpp"
#include "publisher.hpp"
#include "services.hpp"
#include "stage_graph.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "worker.hpp"

namespace pose_graph {

using Clock = std::chrono::steady_clock;
using urban_nav_core::UserError;

/// The pose graph on topics: callbacks convert and enqueue, one worker adds, relaxes and publishes. map -> odom goes out
/// with every odometry message, whatever the worker is at.
class PoseGraphNodelet : public nodelet::Nodelet {
 public:
  ~PoseGraphNodelet() override {
    // First nobody may call any more; then the worker ends.
    subscribers_.clear();
    services_.reset();
    timer_.stop();
    worker_.reset();
  }

 private:
  void onInit() override;
  void subscribe();
  void subscribeOdometry();
  void subscribeAccelerometer();
  template <typename Message, typename Converter>
  void subscribeInput(const std::string& name, bool steady, const Converter& convert);
  Worker::Listener listener();

  // In the worker's thread.
  void relaxed(const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms);
  void idle(const LiveGraph& graph);
  void publishStoreState(const LiveGraph& graph);

  Parameters parameters_;
  NodeletParameters nodelet_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<Accelerometer> accelerometer_;  // of the callbacks of this node's queue, which come one after another
  std::unique_ptr<Worker> worker_;
  std::unique_ptr<Services> services_;
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> paused_dropped_{0}, damaged_{0};

  // The worker's own.
  std::optional<Clock::time_point> last_picture_;
  std::int64_t drawn_revision_ = -1;
  urban_nav_core::StampNs drawn_newest_ = 0;
  std::string store_fault_;
};

void PoseGraphNodelet::onInit() {
  try {
    std::tie(nodelet_, parameters_) = urban_nav_ros::readParameters(getPrivateNodeHandle(), nodeletTable(), table());
  } catch (const UserError& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  publisher_ = std::make_unique<Publisher>(getNodeHandle(), nodelet_);
  diagnostics_ = std::make_unique<Diagnostics>(getNodeHandle(), getPrivateNodeHandle(), getName());
  accelerometer_ = std::make_unique<Accelerometer>(nodelet_.base_frame);
  worker_ = std::make_unique<Worker>(
      std::make_unique<StageGraph>(parameters_, nodelet_.robot, nodelet_.recording, nodelet_.store),
      static_cast<std::size_t>(nodelet_.queue), listener());
  services_ = std::make_unique<Services>(getMTPrivateNodeHandle(), *worker_, [this](bool paused) {
    paused_ = paused;
    diagnostics_->paused(paused);
  });
  subscribe();
  timer_ = getNodeHandle().createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) {
    diagnostics_->worked(worker_->counts(), {paused_dropped_, damaged_});
    diagnostics_->update();
  });
}

template <typename Message, typename Converter>
void PoseGraphNodelet::subscribeInput(const std::string& name, bool steady, const Converter& convert) {
  const std::string topic = getNodeHandle().resolveName(name);
  diagnostics_->expect(topic, steady);
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
      [this, topic, convert](const boost::shared_ptr<const Message>& message) {
        diagnostics_->received(topic);
        const auto input = convert(*message);
        if (!input) {
          ++damaged_;
          NODELET_WARN_THROTTLE(5.0, "%s: a message that is not finite, no pose or of an unknown kind", topic.c_str());
        } else if (paused_) {
          ++paused_dropped_;
        } else {
          worker_->put(*input);
        }
      };
  subscribers_.push_back(
      getNodeHandle().subscribe<Message>(name, static_cast<std::uint32_t>(nodelet_.queue), callback));
}

void PoseGraphNodelet::subscribe() {
  subscribeInput<urban_nav_msgs::RelativePose>("vo/relative_pose", true, urban_nav_ros::toRelativePose);
  subscribeInput<urban_nav_msgs::MetricClosure>("loops/metric", false, urban_nav_ros::toMetricClosure);
  subscribeInput<urban_nav_msgs::RelativeConstraint>("map/constraints", false, urban_nav_ros::toRelativeConstraint);
  subscribeOdometry();
  subscribeAccelerometer();
}

void PoseGraphNodelet::subscribeOdometry() {
  subscribers_.push_back(getNodeHandle().subscribe<nav_msgs::Odometry>(
      "vo/odometry", static_cast<std::uint32_t>(nodelet_.queue), [this](const nav_msgs::OdometryConstPtr& message) {
        const urban_nav_core::StampNs stamp = urban_nav_ros::toStampNs(message->header.stamp);
        if (const auto T_odom_base = urban_nav_ros::toPose(message->pose.pose))
          worker_->put(urban_nav_core::StampedPose{stamp, *T_odom_base});
        else ++damaged_;
        publisher_->sendTransform(stamp);
      }));
}

void PoseGraphNodelet::subscribeAccelerometer() {
  const auto put = [this](const std::vector<SpecificForce>& samples) {
    for (const SpecificForce& sample : samples) worker_->put(sample);
  };
  subscribers_.push_back(getNodeHandle().subscribe<tf2_msgs::TFMessage>(
      "/tf_static", 100,
      [this, put](const tf2_msgs::TFMessageConstPtr& message) { put(accelerometer_->add(*message)); }));
  subscribers_.push_back(getNodeHandle().subscribe<sensor_msgs::Imu>(
      "imu/data", static_cast<std::uint32_t>(nodelet_.queue),
      [this, put](const sensor_msgs::ImuConstPtr& message) { put(accelerometer_->add(*message)); }));
}

Worker::Listener PoseGraphNodelet::listener() {
  Worker::Listener listener;
  listener.relaxed = [this](const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms) {
    relaxed(outcome, graph, ms);
  };
  listener.idle = [this](const LiveGraph& graph) { idle(graph); };
  listener.refused = [this](const std::string& why) {
    NODELET_WARN_THROTTLE(5.0, "%s", why.c_str());
    diagnostics_->refused(why);
  };
  return listener;
}

void PoseGraphNodelet::relaxed(const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms) {
  publisher_->setMapFromOdom(graph.T_map_odom());
  if (outcome.update) publisher_->publish(*outcome.update, graph.newest());
  for (const urban_nav_core::MapJump& jump : outcome.jumps) publisher_->publish(jump);
  publisher_->publish(outcome.status, outcome.reason_name, graph.newest());
  Figures figures = outcome.figures;
  figures.relax_ms = ms;
  publisher_->publish(figures, graph.newest());
  diagnostics_->relaxed(outcome.status, outcome.reason_name, figures);
}

void PoseGraphNodelet::publishStoreState(const LiveGraph& graph) {
  const StoreState state = graph.storeState();
  diagnostics_->stored(state);
  if (state.fault == store_fault_) return;
  if (state.fault.empty()) NODELET_INFO("%s: what is taken in is stored again", state.path.c_str());
  else NODELET_ERROR("store: %s", state.fault.c_str());
  store_fault_ = state.fault;
  const urban_nav_core::Status status = graph.status();
  publisher_->publish(status, toString(static_cast<Trouble>(status.reason)), graph.newest());
}

void PoseGraphNodelet::idle(const LiveGraph& graph) {
  publisher_->setMapFromOdom(graph.T_map_odom());
  publishStoreState(graph);
  const Clock::time_point now = Clock::now();
  const bool due = !last_picture_ || now - *last_picture_ >= std::chrono::duration<double>(nodelet_.picture_period);
  const bool changed = graph.revision() != drawn_revision_ || graph.newest() != drawn_newest_;
  if (!due || !changed || !publisher_->isWatched()) return;
  last_picture_ = now;
  drawn_revision_ = graph.revision();
  drawn_newest_ = graph.newest();
  const LiveGraph::Picture picture = graph.picture();
  publisher_->publishPicture(picture.runs, picture.ties, graph.newest());
}

}  // namespace pose_graph

PLUGINLIB_EXPORT_CLASS(pose_graph::PoseGraphNodelet, nodelet::Nodelet)
