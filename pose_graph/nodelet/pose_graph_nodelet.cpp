// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/RelativeConstraint.h>
#include <urban_nav_msgs/RelativePose.h>
#include <pluginlib/class_list_macros.hpp>

#include <chrono>
#include <optional>
#include <tuple>

#include "live/live_pose_graph.hpp"
#include "publisher.hpp"
#include "services.hpp"
#include "urban_nav_ros/accelerometer.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/gps_fixes.hpp"
#include "urban_nav_ros/ground_normals.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/topics.hpp"

namespace pose_graph {

namespace topics = urban_nav_ros::topics;
using urban_nav_core::StampNs;
using urban_nav_ros::TopicOptions;
using Clock = std::chrono::steady_clock;

namespace {

// s; delay of the first smoothed pose of a filter with a window; later poses arrive at the rate of its images.
constexpr double kOdometryTimeout = 5.0;
// s after an interrupt during which the last poses and closures of other stages are received and stored.
constexpr double kDrain = 10.0;

}  // namespace

/// Pose graph on topics. map -> odom is published with every odometry message, independent of the worker.
class PoseGraphStage {
 public:
  static constexpr const char* name = "pose_graph";
  static constexpr const char* topic = "map";
  using Input = GraphWorker::Input;
  using Node = GraphNode;

  explicit PoseGraphStage(Node& node);

  void handle(Input& input) { worker_->add(input); }
  bool idle() {
    worker_->step();
    return false;
  }
  std::string reset() {
    worker_->graph().reset();
    return "the graph is empty";
  }
  void finish(std::chrono::milliseconds /*limit*/) { worker_->step(); }
  static constexpr int kFinishOrder = 2;
  void close() {}
  urban_nav_live::StageReport report() const {
    urban_nav_live::StageReport report = worker_->report();
    accelerometer_->addTo(report);
    if (ground_->isAssumed())
      report.warn("no static tf from " + nodelet_.base_frame + " to the camera of " + topics::kGroundPlane +
                  ": assuming the axes of REP 103");
    if (fixes_ && fixes_->isAssumed())
      report.warn("no static tf from " + nodelet_.base_frame + " to the antenna of " + topics::kGpsFix +
                  ": assuming the origin of the robot");
    return report;
  }

 private:
  GraphWorker::Listener listener();
  void subscribe();
  void subscribeGravity();
  void subscribeGps();
  template <typename Sample>
  bool pushAll(const std::vector<Sample>& samples) {
    for (const Sample& sample : samples) node_.push(sample);
    return !samples.empty();
  }
  void relaxed(const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms);
  void publishIdle(const LiveGraph& graph);
  void followStore(const LiveGraph& graph);

  Node& node_;
  NodeletParameters nodelet_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<urban_nav_ros::Accelerometer>
      accelerometer_;  // of the callbacks of the node's queue, which are sequential
  // As accelerometer_. Unsubscribed at the first sample of an accelerometer, because dense stereo is expensive.
  std::unique_ptr<urban_nav_ros::GroundNormals> ground_;
  ros::Subscriber ground_subscriber_;
  std::unique_ptr<urban_nav_ros::GpsFixes> fixes_;  // as accelerometer_; null: GPS is disabled
  std::unique_ptr<GraphWorker> worker_;

  std::optional<Clock::time_point> last_picture_;
  std::int64_t drawn_revision_ = -1;
  StampNs drawn_newest_ = 0;
};

PoseGraphStage::PoseGraphStage(Node& node) : node_(node) {
  Parameters parameters;
  std::tie(nodelet_, parameters) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, kDrain);
  publisher_ = std::make_unique<Publisher>(node.nh(), nodelet_);
  accelerometer_ =
      std::make_unique<urban_nav_ros::Accelerometer>(nodelet_.base_frame, node.sensors().corrections().accelerometer);
  ground_ = std::make_unique<urban_nav_ros::GroundNormals>(nodelet_.base_frame);
  if (parameters.gps) fixes_ = std::make_unique<urban_nav_ros::GpsFixes>(nodelet_.base_frame);
  worker_ = std::make_unique<GraphWorker>(
      std::make_unique<LivePoseGraph>(parameters, nodelet_.robot, nodelet_.recording, nodelet_.store), listener());
  advertiseServices(node, *worker_);
  subscribe();
}

void PoseGraphStage::subscribe() {
  TopicOptions steady, occasional;
  steady.timeout = kOdometryTimeout;
  steady.queue = occasional.queue = nodelet_.queue_size;
  occasional.is_monitored = false;
  steady.is_awaited = occasional.is_awaited = true;
  node_.subscribeInput<urban_nav_msgs::RelativePose>(
      topics::kRelativePose, steady, [](const auto& message) { return urban_nav_ros::toSessionStep(*message); });
  node_.subscribeInput<urban_nav_msgs::MetricClosure>(
      topics::kMetricClosure, occasional, [](const auto& message) { return urban_nav_ros::toMetricClosure(*message); });
  TopicOptions unawaited = occasional;
  unawaited.is_awaited = false;
  node_.subscribeInput<urban_nav_msgs::RelativeConstraint>(topics::kMapConstraints, unawaited, [](const auto& message) {
    return urban_nav_ros::toRelativeConstraint(*message);
  });
  TopicOptions always = unawaited;
  always.is_paused = false;
  node_.subscribe<nav_msgs::Odometry>(topics::kOdometry, always, [this](const nav_msgs::OdometryConstPtr& message) {
    const StampNs stamp = urban_nav_ros::toStampNs(message->header.stamp);
    if (const auto T_odom_base = urban_nav_ros::toPose(message->pose.pose))
      node_.push(urban_nav_core::StampedPose{stamp, *T_odom_base});
    else node_.gate().countInvalid();
    publisher_->sendTransform(stamp);
  });
  subscribeGravity();
  if (fixes_) subscribeGps();
}

void PoseGraphStage::subscribeGps() {
  TopicOptions options;
  options.is_monitored = options.is_paused = false;
  options.queue = nodelet_.queue_size;
  node_.subscribe<sensor_msgs::NavSatFix>(topics::kGpsFix, options,
                                          [this](const auto& message) { pushAll(fixes_->add(*message)); });
}

void PoseGraphStage::subscribeGravity() {
  TopicOptions options;
  options.is_monitored = options.is_paused = false;
  node_.subscribe<tf2_msgs::TFMessage>(topics::kStaticTransforms, options, [this](const auto& message) {
    pushAll(accelerometer_->add(*message));
    pushAll(ground_->add(*message));
    if (fixes_) pushAll(fixes_->add(*message));
  });
  options.queue = nodelet_.queue_size;
  node_.subscribe<sensor_msgs::Imu>(topics::kImu, options, [this](const auto& message) {
    if (pushAll(accelerometer_->add(*message))) ground_subscriber_.shutdown();
  });
  if (!nodelet_.ground) return;
  const boost::function<void(const urban_nav_msgs::GroundPlaneConstPtr&)> add =
      [this](const urban_nav_msgs::GroundPlaneConstPtr& message) { pushAll(ground_->add(*message)); };
  ground_subscriber_ = node_.nh().subscribe<urban_nav_msgs::GroundPlane>(
      topics::kGroundPlane, static_cast<std::uint32_t>(nodelet_.queue_size), add);
}

GraphWorker::Listener PoseGraphStage::listener() {
  GraphWorker::Listener listener;
  listener.relaxed = [this](const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms) {
    relaxed(outcome, graph, ms);
  };
  listener.idle = [this](const LiveGraph& graph) { publishIdle(graph); };
  listener.refused = [this](const std::string& why) { node_.logWarning("refused", why); };
  listener.wake = [this] { node_.loop().wake(); };
  return listener;
}

void PoseGraphStage::relaxed(const LiveGraph::Outcome& outcome, const LiveGraph& graph, double ms) {
  publisher_->setMapFromOdom(graph.T_map_odom());
  publisher_->publish(outcome, graph.newest(), ms);
  node_.publishStatus(outcome.status, outcome.reason_name, graph.newest());
}

void PoseGraphStage::followStore(const LiveGraph& graph) {
  if (!node_.followStore(graph.storeState())) return;
  const urban_nav_core::Status status = graph.status();
  node_.publishStatus(status, toString(static_cast<Trouble>(status.reason)), graph.newest());
}

void PoseGraphStage::publishIdle(const LiveGraph& graph) {
  publisher_->setMapFromOdom(graph.T_map_odom());
  followStore(graph);
  const Clock::time_point now = Clock::now();
  const bool due =
      !last_picture_ || now - *last_picture_ >= std::chrono::duration<double>(nodelet_.visualization_period);
  const bool changed = graph.revision() != drawn_revision_ || graph.newest() != drawn_newest_;
  if (!due || !changed || !publisher_->isWatched()) return;
  const LiveGraph::Picture picture = graph.picture();
  if (!last_picture_ && picture.segments.empty()) return;  // the first pose is published without waiting for a period
  last_picture_ = now;
  drawn_revision_ = graph.revision();
  drawn_newest_ = graph.newest();
  publisher_->publish(picture, graph.newest());
}

class PoseGraphNodelet : public urban_nav_ros::StageNodelet<PoseGraphStage> {};

}  // namespace pose_graph

PLUGINLIB_EXPORT_CLASS(pose_graph::PoseGraphNodelet, nodelet::Nodelet)
