// SPDX-License-Identifier: BSD-3-Clause
#include <urban_nav_msgs/TopologicalClosure.h>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "live/loops_report.hpp"
#include "live/nodelet_parameters.hpp"
#include "publisher.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/robot_inputs.hpp"
#include "urban_nav_ros/robot_topics.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"

namespace loop_metric {

using urban_nav_live::StoreWriterLink;
using urban_nav_ros::ImageInput;
using urban_nav_ros::InfoInput;

namespace {

// A reset waits for pending candidates, and a caller of the service at most this long.
constexpr std::chrono::seconds kResetTimeout{25};

StoreWriterLink::Options storeOptions() {
  StoreWriterLink::Options options;
  options.empty_path = StoreWriterLink::EmptyPath::TemporaryFile;
  return options;
}

}  // namespace

/// Loop closures on topics: the worker records keyframes, scans, sweeps and odometry, the verifier measures candidates
/// in a separate thread.
class LoopMetricStage {
 public:
  static constexpr const char* name = "loop_metric";
  static constexpr const char* topic = "loop closures";
  using Input = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr,
                             sensor_msgs::PointCloud2ConstPtr, urban_nav_core::StampedTurn, urban_nav_core::StampedPose,
                             urban_nav_core::SessionStep>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit LoopMetricStage(Node& node);

  void handle(Input& input) {
    std::visit([this](const auto& each) { inputs_->handle(each); }, input);
  }
  bool idle();
  std::string reset();
  void finish(std::chrono::milliseconds limit) {
    recorder_->end();
    if (limit.count() > 0 && !verifier_->finishSession(limit)) node_.logError(givenUp(verifier_->counts().waiting));
    store_->flush();
  }
  void close() { finish(ros::ok() ? node_.drainTime() : std::chrono::milliseconds(0)); }
  urban_nav_live::StageReport report() const { return makeReport(state()); }

 private:
  using Inputs = urban_nav_ros::RobotInputs<SessionRecorder, urban_nav_registration::MountedCamera>;
  void subscribeCandidates();
  void publish(const ClosureVerifier::Verdict& verdict);
  void logStore(const urban_nav_live::StoreState& store);
  LoopsState state() const;

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  mutable std::mutex mutex_;
  std::string last_verdict_;  // guarded by mutex_, like the next member
  double last_ms_ = 0.0;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<StoreWriterLink> store_;
  std::unique_ptr<ClosureVerifier> verifier_;
  std::unique_ptr<SessionRecorder> recorder_;
  std::unique_ptr<Inputs> inputs_;
  std::atomic<std::int64_t> candidates_{0};
  std::int64_t store_lost_ = 0;
};

LoopMetricStage::LoopMetricStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_, parameters_.registration) = urban_nav_ros::readParameters(
      node.nh(), node.privateHandle(), nodeletTable(), table(), urban_nav_registration::table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  publisher_ = std::make_unique<Publisher>(node.nh(), nodelet_.base_frame);
  store_ = std::make_unique<StoreWriterLink>(nodelet_.store, storeOptions());
  verifier_ = std::make_unique<ClosureVerifier>(parameters_, nodelet_.candidate_timeout, *store_,
                                                [this](const auto& verdict) { publish(verdict); });
  recorder_ = std::make_unique<SessionRecorder>(
      parameters_.registration, SessionRecorder::Options{nodelet_.robot, nodelet_.recording}, *store_, *verifier_);
  inputs_ = std::make_unique<Inputs>(urban_nav_ros::toStereoOptions(nodelet_, node.nh()), *recorder_,
                                     Inputs::Listener{[this](const std::string& fault) { node_.logError(fault); },
                                                      [this] { node_.gate().countInvalid(); }});
  subscribeRobot(node, nodelet_.queue_size, parameters_.stereo, nodelet_.compressed, parameters_.icp);
  subscribeCandidates();
}

void LoopMetricStage::subscribeCandidates() {
  urban_nav_ros::TopicOptions options;
  options.queue = nodelet_.queue_size;
  options.is_monitored = false;
  options.is_awaited = true;
  node_.subscribe<urban_nav_msgs::TopologicalClosure>(
      urban_nav_ros::topics::kPlaceClosure, options, [this](const auto& message) {
        if (const auto closure = urban_nav_ros::toTopologicalClosure(*message)) {
          ++candidates_;
          return verifier_->push(ClosureVerifier::Candidate{*closure, std::chrono::steady_clock::now()});
        }
        node_.gate().countInvalid();
        node_.logWarning("candidate", "places/closure: message without stamps, or with a probability outside 0...1");
      });
}

bool LoopMetricStage::idle() {
  inputs_->idle();
  recorder_->idle();
  const LoopsState now = state();
  const urban_nav_live::StageReport report = makeReport(now);
  node_.publishStatus(report.status, report.reason_name, urban_nav_ros::toStampNs(ros::Time::now()));
  logStore(now.store);
  return false;
}

std::string LoopMetricStage::reset() {
  recorder_->end();
  if (!verifier_->finishSession(kResetTimeout))
    throw urban_nav_core::UserError("", "candidates are still being measured; try again later", "");
  return "waiting candidates were measured; the next step of odometry begins a new session";
}

void LoopMetricStage::publish(const ClosureVerifier::Verdict& verdict) {
  publisher_->publish(verdict);
  const urban_nav_core::MetricClosure& closure = verdict.metric;
  const std::lock_guard<std::mutex> lock(mutex_);
  last_verdict_ = std::string(toString(closure.verdict)) + " (" +
                  (closure.reason_name.empty() ? toString(closure.method) : closure.reason_name) +
                  "): " + closure.sentence;
  last_ms_ = verdict.ms;
}

void LoopMetricStage::logStore(const urban_nav_live::StoreState& store) {
  if (store.lost + store.refused > store_lost_)
    node_.logWarning("store", "store: " + std::to_string(store.lost) +
                                  " keyframes, scans or steps of odometry are lost so far, and " +
                                  std::to_string(store.refused) + " were refused");
  store_lost_ = store.lost + store.refused;
  node_.followStore(store);
}

LoopsState LoopMetricStage::state() const {
  LoopsState state;
  state.stereo = parameters_.stereo;
  state.clouds = parameters_.icp;
  state.paused = node_.gate().isPaused();
  state.recorder = recorder_->state();
  state.verifier = verifier_->counts();
  state.store = store_->state();
  const urban_nav_live::TopicMonitor& monitor = node_.monitor();
  state.odometry_fault = monitor.fault(urban_nav_ros::topic_groups::kOdometry);
  state.image_fault = monitor.fault(urban_nav_ros::topic_groups::kImages);
  state.laser_fault = monitor.fault(urban_nav_ros::topic_groups::kLasers);
  state.camera_fault = inputs_->sessions().fault();
  state.laser_pose_fault = inputs_->laserFault();
  state.beams = inputs_->beams();
  state.camera = inputs_->mountingFault();
  state.damaged_images = inputs_->sessions().counts().damaged;
  state.candidates = candidates_;
  const std::lock_guard<std::mutex> lock(mutex_);
  state.last_verdict = last_verdict_;
  state.last_ms = last_ms_;
  return state;
}

class LoopMetricNodelet : public urban_nav_ros::StageNodelet<LoopMetricStage> {};

}  // namespace loop_metric

PLUGINLIB_EXPORT_CLASS(loop_metric::LoopMetricNodelet, nodelet::Nodelet)
