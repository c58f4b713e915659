// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/TopologicalClosure.h>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <functional>
#include <tuple>
#include <vector>

#include "diagnostics.hpp"
#include "judge.hpp"
#include "publisher.hpp"
#include "recorder.hpp"
#include "stage_store.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/trigger.hpp"

namespace loop_metric {

using urban_nav_core::UserError;
using urban_nav_ros::Side;
using urban_nav_ros::toStampNs;

namespace {

// A reset waits for the candidates that wait: a caller does not wait longer than this.
constexpr std::chrono::seconds reset_patience{30};

}  // namespace

/// Loop closures on topics: callbacks enqueue; one thread keeps views, scans and odometry in a store, another one takes candidates to their
/// verdicts with what is there.
class LoopMetricNodelet : public nodelet::Nodelet {
 public:
  ~LoopMetricNodelet() override {
    // First nobody may call any more; then the threads end, those who ask before those who are asked.
    subscribers_.clear();
    services_.clear();
    timer_.stop();
    recorder_.reset();
    judge_.reset();
  }

 private:
  void onInit() override;
  void subscribe();
  void advertiseServices();
  template <typename Message, typename Take>
  void listen(const std::string& name, Diagnostics::Kind kind, const Take& take);
  template <typename Message>
  void listenToImages(const std::string& name, Side side);
  void tell();

  Parameters parameters_;
  NodeletParameters nodelet_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<StageStore> store_;
  std::unique_ptr<Judge> judge_;
  std::unique_ptr<Recorder> recorder_;
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> candidates_{0}, paused_dropped_{0}, damaged_{0};
  std::string store_fault_;  // the timer's
};

void LoopMetricNodelet::onInit() {
  try {
    std::tie(nodelet_, parameters_) = urban_nav_ros::readParameters(getPrivateNodeHandle(), nodeletTable(), table());
  } catch (const UserError& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  ros::NodeHandle& nh = getNodeHandle();
  publisher_ = std::make_unique<Publisher>(nh, nodelet_.base_frame);
  diagnostics_ =
      std::make_unique<Diagnostics>(nh, getPrivateNodeHandle(), getName(), parameters_.stereo, parameters_.icp);
  store_ = std::make_unique<StageStore>(nodelet_.store);
  judge_ = std::make_unique<Judge>(parameters_, nodelet_.patience, *store_, [this](const Judge::Verdict& verdict) {
    publisher_->publish(verdict);
    diagnostics_->judged(verdict.metric, verdict.ms);
  });
  const bool rectified = urban_nav_ros::areRectified(nodelet_.images, nh.resolveName("stereo/left/image_raw"));
  recorder_ = std::make_unique<Recorder>(parameters_, nodelet_, rectified, nh.resolveName("stereo"), *store_, *judge_);
  subscribe();
  advertiseServices();
  timer_ = nh.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { tell(); });
}

template <typename Message, typename Take>
void LoopMetricNodelet::listen(const std::string& name, Diagnostics::Kind kind, const Take& take) {
  const std::string topic = getNodeHandle().resolveName(name);
  diagnostics_->expect(topic, kind);
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
      [this, topic, kind, take](const boost::shared_ptr<const Message>& message) {
        diagnostics_->received(topic);
        // Odometry is followed all the time, so that the session goes on behind a pause.
        if (paused_ && kind != Diagnostics::Kind::Odometry) ++paused_dropped_;
        else take(message);
      };
  subscribers_.push_back(
      getNodeHandle().subscribe<Message>(name, static_cast<std::uint32_t>(nodelet_.queue), callback));
}

template <typename Message>
void LoopMetricNodelet::listenToImages(const std::string& name, Side side) {
  listen<Message>(name, Diagnostics::Kind::Images, [this, side](const boost::shared_ptr<const Message>& message) {
    recorder_->put(ImageInput{side, message, toStampNs(message->header.stamp)});
  });
}

void LoopMetricNodelet::subscribe() {
  using Kind = Diagnostics::Kind;
  subscribers_.push_back(getNodeHandle().subscribe<tf2_msgs::TFMessage>(
      "/tf_static", 100, [this](const tf2_msgs::TFMessageConstPtr& message) { recorder_->put(message); }));
  if (parameters_.stereo) {
    for (const auto& [side, name] : {std::pair(Side::Left, "left"), std::pair(Side::Right, "right")}) {
      const std::string images = std::string("stereo/") + name + "/image_raw";
      listen<sensor_msgs::CameraInfo>(std::string("stereo/") + name + "/camera_info", Kind::Images,
                                      [this, side = side](const sensor_msgs::CameraInfoConstPtr& message) {
                                        recorder_->put(Recorder::InfoInput{side, message});
                                      });
      if (nodelet_.compressed) listenToImages<sensor_msgs::CompressedImage>(images, side);
      else listenToImages<sensor_msgs::Image>(images, side);
    }
  }
  if (parameters_.icp)
    for (const char* name : {"laser_left/scan", "laser_right/scan"})
      listen<sensor_msgs::LaserScan>(
          name, Kind::Lasers, [this](const sensor_msgs::LaserScanConstPtr& message) { recorder_->put(message); });
  listen<nav_msgs::Odometry>("vo/odometry", Kind::Odometry, [this](const nav_msgs::OdometryConstPtr& message) {
    if (const auto T_odom_base = urban_nav_ros::toPose(message->pose.pose))
      recorder_->put(urban_nav_core::StampedPose{toStampNs(message->header.stamp), *T_odom_base});
    else ++damaged_;
  });
  listen<urban_nav_msgs::RelativePose>("vo/relative_pose", Kind::Odometry,
                                       [this](const urban_nav_msgs::RelativePoseConstPtr& message) {
                                         if (const auto step = urban_nav_ros::toRelativePose(*message))
                                           recorder_->put(*step);
                                         else ++damaged_;
                                       });
  listen<urban_nav_msgs::TopologicalClosure>(
      "places/closure", Kind::Closures, [this](const urban_nav_msgs::TopologicalClosureConstPtr& message) {
        if (const auto closure = urban_nav_ros::toTopologicalClosure(*message)) {
          ++candidates_;
          judge_->put(Judge::Candidate{*closure, std::chrono::steady_clock::now()});
        } else {
          ++damaged_;
          NODELET_WARN_THROTTLE(5.0, "places/closure: a message without stamps, or with a probability outside 0...1");
        }
      });
}

void LoopMetricNodelet::advertiseServices() {
  const auto advertise = [this](const char* name, const std::function<std::string()>& action) {
    services_.push_back(urban_nav_ros::advertiseTrigger(getMTPrivateNodeHandle(), name, action));
  };
  advertise("reset", [this] {
    const auto done = std::make_shared<std::promise<void>>();
    recorder_->put(Recorder::Reset{done});
    const bool ended = done->get_future().wait_for(reset_patience) == std::future_status::ready;
    return ended ? "what waited has its verdict, the next step of odometry begins a new session" : "";
  });
  advertise("pause", [this] {
    paused_ = true;
    diagnostics_->paused(true);
    return "views, scans and candidates are dropped until resume; odometry is followed";
  });
  advertise("resume", [this] {
    paused_ = false;
    diagnostics_->paused(false);
    return "the session goes on";
  });
}

void LoopMetricNodelet::tell() {
  const StoreState store = store_->state();
  diagnostics_->worked(recorder_->state(), judge_->counts(), store, {candidates_, paused_dropped_, damaged_});
  publisher_->publish(diagnostics_->status());
  diagnostics_->update();
  if (store.fault == store_fault_) return;
  if (store.fault.empty()) NODELET_INFO("%s: what comes is stored again", store.path.c_str());
  else NODELET_ERROR("store: %s", store.fault.c_str());
  store_fault_ = store.fault;
}

}  // namespace loop_metric

PLUGINLIB_EXPORT_CLASS(loop_metric::LoopMetricNodelet, nodelet::Nodelet)
