// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <ros/ros.h>
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
#include "subscriptions.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/trigger.hpp"

namespace loop_metric {

using urban_nav_core::UserError;

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
    if (subscriptions_) subscriptions_->end();
    services_.clear();
    timer_.stop();
    recorder_.reset();
    judge_.reset();
  }

 private:
  void onInit() override;
  void subscribe();
  void advertiseServices();
  void tell();

  Parameters parameters_;
  NodeletParameters nodelet_;
  HeardTopics topics_;
  std::unique_ptr<Subscriptions> subscriptions_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<StageStore> store_;
  std::unique_ptr<Judge> judge_;
  std::unique_ptr<Recorder> recorder_;
  std::atomic<std::int64_t> candidates_{0};
  std::string store_fault_;      // the timer's, as what follows
  std::int64_t store_lost_ = 0;  // writes
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
  diagnostics_ = std::make_unique<Diagnostics>(nh, getPrivateNodeHandle(), getName(), topics_, parameters_.stereo,
                                               parameters_.icp);
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

void LoopMetricNodelet::subscribe() {
  using Kind = HeardTopics::Kind;
  subscriptions_ = std::make_unique<Subscriptions>(getNodeHandle(), nodelet_.queue, topics_);
  subscriptions_->listenToRobot(parameters_.stereo, nodelet_.compressed, *recorder_);
  if (parameters_.icp)
    for (const char* name : {"laser_left/scan", "laser_right/scan"})
      subscriptions_->listen<sensor_msgs::LaserScan>(
          name, Kind::Lasers, [this](const sensor_msgs::LaserScanConstPtr& message) { recorder_->put(message); });
  subscriptions_->listen<urban_nav_msgs::TopologicalClosure>(
      "places/closure", Kind::Closures, [this](const urban_nav_msgs::TopologicalClosureConstPtr& message) {
        if (const auto closure = urban_nav_ros::toTopologicalClosure(*message)) {
          ++candidates_;
          judge_->put(Judge::Candidate{*closure, std::chrono::steady_clock::now()});
        } else {
          subscriptions_->countDamaged();
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
    subscriptions_->pause(true);
    diagnostics_->paused(true);
    return "views, scans and candidates are dropped until resume; odometry is followed";
  });
  advertise("resume", [this] {
    subscriptions_->pause(false);
    diagnostics_->paused(false);
    return "the session goes on";
  });
}

void LoopMetricNodelet::tell() {
  const StoreState store = store_->state();
  diagnostics_->worked(recorder_->state(), judge_->counts(), store,
                       {candidates_, subscriptions_->pausedDropped(), subscriptions_->damaged()});
  publisher_->publish(diagnostics_->status());
  diagnostics_->update();
  if (store.lost + store.refused > store_lost_)
    NODELET_ERROR_THROTTLE(10.0, "store: %ld views, scans or steps of odometry are lost by now, and %ld were refused",
                           static_cast<long>(store.lost), static_cast<long>(store.refused));
  store_lost_ = store.lost + store.refused;
  if (store.fault == store_fault_) return;
  if (store.fault.empty()) NODELET_INFO("%s: what comes is stored again", store.path.c_str());
  else NODELET_ERROR("store: %s", store.fault.c_str());
  store_fault_ = store.fault;
}

}  // namespace loop_metric

PLUGINLIB_EXPORT_CLASS(loop_metric::LoopMetricNodelet, nodelet::Nodelet)
