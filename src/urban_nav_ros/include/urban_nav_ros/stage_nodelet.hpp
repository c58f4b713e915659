// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>
#include <ros/this_node.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "urban_nav_ros/orderly_end.hpp"
#include "urban_nav_ros/stage_node.hpp"

namespace urban_nav_ros {

/// Nodelet of a live stage. Callbacks convert and enqueue; one worker passes the inputs to the stage, which publishes.
/// Provides fatal errors for invalid parameters, the services ~reset, ~pause, ~resume and, for stages with finish(),
/// ~finish; `<stage>/status`, and /diagnostics once a second.
///
/// A stage is a class with its topics and converters, and an algorithm that is independent of ROS:
///
///     class FrameCounter {
///      public:
///       static constexpr const char* name = "frame_counter";   // of <name>/status
///       static constexpr const char* topic = "frames";         // title of the diagnostics
///       using Input = urban_nav_core::StampNs;
///       using Node = urban_nav_ros::StageNodeWith<Input>;
///
///       // Reads parameters (Errors are fatal), subscribes, advertises.
///       explicit FrameCounter(Node& node) : node_(node) {
///         std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
///         node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
///         count_ = node.nh().advertise<std_msgs::UInt64>("frame_counter/count", 10);
///         node.subscribeInput<sensor_msgs::Image>(
///             topics::left_image, {1.0}, [](const auto& image) { return toStampNs(image->header.stamp); });
///       }
///       // Called by the worker, as are all functions below.
///       void handle(Input& stamp);
///       // Called before the first input and after each round of inputs. Returns true to be called again at once.
///       bool idle() { return false; }
///       std::string reset() { counter_ = {}; return "the count is 0"; }
///       void close() {}                                      // before the nodelet ends
///       // Optional. Called when the process is interrupted, and by ~finish after all earlier inputs: publishes or
///       // decides pending data within `limit`; later inputs begin a new session. After an interrupt, all messages of
///       // topics with TopicOptions::is_awaited have been handled before.
///       void finish(std::chrono::milliseconds limit);
///       // Optional. Stages of a process finish in ascending order; 0 is that of odometry.
///       static constexpr int kFinishOrder = 1;
///       urban_nav_live::StageReport report() const;          // after each idle()
///      private:
///       ...
///     };
///     class FrameCounterNodelet : public urban_nav_ros::StageNodelet<FrameCounter> {};
///     PLUGINLIB_EXPORT_CLASS(frame_counter::FrameCounterNodelet, nodelet::Nodelet)
///
/// Order of destruction: subscriptions and services end, the worker closes the stage and ends, the stage is destroyed.
template <typename Stage>
class StageNodelet : public nodelet::Nodelet {
 public:
  ~StageNodelet() override {
    if (!node_) return;
    if (number_) OrderlyEnd::ofProcess().remove(*number_);
    timer_.stop();
    node_->shutDown();
    node_->loop().stop();
    stage_.reset();
  }

 private:
  using Node = StageNodeWith<typename Stage::Input>;

  void onInit() override {
    try {
      node_ = std::make_unique<Node>(
          StageNode::Handles{getNodeHandle(), getPrivateNodeHandle(), getMTPrivateNodeHandle(), getName()}, Stage::name,
          Stage::topic);
      stage_ = std::make_unique<Stage>(*node_);
    } catch (const urban_nav_core::Error& error) {
      NODELET_FATAL("%s", error.what());
      node_.reset();  // first, because the loader destroys the callback queues before the nodelet
      throw;
    }
    start();
    number_ = OrderlyEnd::ofProcess().add(finishOrder(0), [this] { finish(0); });
    advertiseServices();
    timer_ = getNodeHandle().createWallTimer(ros::WallDuration(1.0),
                                             [this](const ros::WallTimerEvent&) { node_->update(); });
  }

  void start() {
    typename urban_nav_live::WorkerLoop<typename Stage::Input>::Steps steps;
    steps.begin = [this] { idle(); };
    steps.handle = [this](typename Stage::Input& input) { stage_->handle(input); };
    steps.idle = [this] { return idle(); };
    steps.end = [this] { stage_->close(); };
    node_->loop().start(Stage::name, std::move(steps));
  }

  bool idle() {
    const bool busy = stage_->idle();
    node_->setReport(stage_->report(), node_->loop().dropped(), node_->loop().pushed());
    return busy;
  }

  void advertiseServices() {
    using std_srvs::Trigger;
    node_->template advertiseService<Trigger>("reset", [this](const Trigger::Request&, Trigger::Response& response) {
      response.message = node_->ask([this] { return stage_->reset(); });
    });
    node_->template advertiseService<Trigger>("pause", [this](const Trigger::Request&, Trigger::Response& response) {
      node_->gate().pause();
      response.message = "inputs are dropped until resume; odometry is followed";
    });
    node_->template advertiseService<Trigger>("resume", [this](const Trigger::Request&, Trigger::Response& response) {
      node_->gate().resume();
      response.message = "the session continues";
    });
    advertiseFinish(0);
  }

  // Members of the stage are preferred in overload resolution: int needs no conversion.
  template <typename S = Stage>
  static constexpr auto finishOrder(int) -> decltype(S::kFinishOrder + 0) {
    return S::kFinishOrder;
  }
  static constexpr int finishOrder(long) { return 1; }

  template <typename S = Stage>
  auto finish(int) -> decltype(std::declval<S&>().finish(std::chrono::milliseconds())) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + node_->drainTime();
    node_->awaitInputs(end);
    const auto left = std::max(std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()), kLeastDrain);
    const auto done = node_->loop().ask(
        [this, left] {
          stage_->finish(left);
          return true;
        },
        left + kLeastDrain);
    if (!done) node_->logError("pending inputs were not decided within drain_s and are dropped");
  }
  void finish(long) {}

  template <typename S = Stage>
  auto advertiseFinish(int) -> decltype(std::declval<S&>().finish(std::chrono::milliseconds())) {
    using std_srvs::Trigger;
    node_->template advertiseService<Trigger>("finish", [this](const Trigger::Request&, Trigger::Response& response) {
      const auto finish = [this] {
        stage_->finish(kPatience);
        return std::string("all inputs so far are processed");
      };
      response.message = node_->ask(finish, kPatience);
    });
  }
  void advertiseFinish(long) {}

  static constexpr std::chrono::milliseconds kLeastDrain{500};
  static constexpr std::chrono::hours kPatience{1};  // of ~finish, whose caller waits for the result

  std::unique_ptr<Node> node_;
  std::unique_ptr<Stage> stage_;  // uses the node
  std::optional<int> number_;     // in OrderlyEnd
  ros::WallTimer timer_;
};

}  // namespace urban_nav_ros
