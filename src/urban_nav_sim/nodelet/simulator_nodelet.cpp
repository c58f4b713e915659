// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "diagnostics.hpp"
#include "live/playback_control.hpp"
#include "live/rate_controller.hpp"
#include "live/simulator_parameters.hpp"
#include "topic_publisher.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/parameters.hpp"

namespace urban_nav_sim {

using Clock = std::chrono::steady_clock;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr std::chrono::milliseconds kTick{100};  // period of repeating /clock while time stops
constexpr std::chrono::seconds kLastWords{1};    // time for publishers to send their queues

}  // namespace

/// The simulated robot on topics: one worker simulates the session, converts and publishes at the requested rate, or as
/// fast as it renders.
class SimulatorNodelet : public nodelet::Nodelet {
 public:
  ~SimulatorNodelet() override {
    // Callbacks end before the worker.
    services_.clear();
    timer_.stop();
    orders_.close();
    if (worker_.joinable()) worker_.join();
  }

 private:
  void onInit() override;
  void readParameters();
  void advertiseServices();

  // Runs in the thread of the worker.
  void work();
  bool drive();
  void publish(const std::vector<TopicMessage>& messages, StampNs taken);
  template <typename Due>
  bool hold(const char* state, const Due& due);
  void report(const char* state, StampNs taken);

  SimulatorParameters parameters_;
  SessionOptions options_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  std::unique_ptr<Diagnostics> diagnostics_;
  PlaybackControl orders_;
  std::thread worker_;

  // Used only by the worker after its start.
  std::unique_ptr<TopicPublisher> outlet_;
  Clock::time_point begin_;  // no message is sent before
  std::optional<RateController> pace_;
  StampNs session_begin_ = 0, now_ = 0;
  std::int64_t published_ = 0;  // in this session
  bool slowness_reported_ = false;
};

void SimulatorNodelet::onInit() {
  try {
    readParameters();
  } catch (const UserError& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  orders_.pause(parameters_.paused);
  outlet_ = std::make_unique<TopicPublisher>(getNodeHandle(), options_.sensors,
                                             static_cast<std::uint32_t>(parameters_.queue));
  begin_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(parameters_.delay));
  const std::string session = options_.world + ", seed " + std::to_string(options_.seed) + ", route " + options_.route +
                              ", day " + std::to_string(options_.day);
  NODELET_INFO("%s, %g s: building the world", session.c_str(), options_.duration);
  if (!outlet_->keepsTime())
    NODELET_WARN("use_sim_time is not set: no /clock; stamps are those of the session, not of today");
  diagnostics_ = std::make_unique<Diagnostics>(getNodeHandle(), getPrivateNodeHandle(), getName(), session,
                                               options_.duration, parameters_.rate);
  advertiseServices();
  timer_ = getNodeHandle().createWallTimer(ros::WallDuration(1.0),
                                           [this](const ros::WallTimerEvent&) { diagnostics_->update(); });
  worker_ = urban_nav_core::namedThread("simulator", [this] { work(); });
}

void SimulatorNodelet::readParameters() {
  const std::string where = getPrivateNodeHandle().getNamespace();
  parameters_ = load(simulatorTable(), serverParameters(simulatorTable().stage(),
                                                        urban_nav_ros::serverValues(getPrivateNodeHandle()), where))
                    .parameters;
  options_ = sessionOptions(parameters_, where + "/");
}

void SimulatorNodelet::advertiseServices() {
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  const auto advertise = [this](const char* name, const char* answer, const auto& action) {
    const boost::function<bool(Request&, Response&)> callback = [action, answer](Request&, Response& response) {
      action();
      response.message = answer;
      response.success = true;
      return true;
    };
    services_.push_back(getPrivateNodeHandle().advertiseService(name, callback));
  };
  advertise("reset", "the session begins again", [this] { orders_.reset(); });
  advertise("pause", "time stops until resume", [this] { orders_.pause(true); });
  advertise("resume", "the session continues", [this] { orders_.pause(false); });
}

void SimulatorNodelet::work() try {
  const urban_nav_core::ThreadLimit threads(parameters_.threads);
  while (orders_.begin()) {
    if (!drive()) continue;
    NODELET_INFO("the session is over: %g s, %ld messages", options_.duration, static_cast<long>(published_));
    report("over", now_);
    const Clock::time_point end = parameters_.exit ? Clock::now() + kLastWords : Clock::time_point::max();
    if (!hold("over", [end] { return end; })) continue;
    return ros::requestShutdown();
  }
} catch (const urban_nav_core::Error& error) {
  NODELET_FATAL("%s", error.what());
  ros::requestShutdown();
}

/// Runs the session from begin to end; returns false to stop.
bool SimulatorNodelet::drive() {
  report("building the world", now_);
  Session session(options_);
  MeasurementMessages messages(session);
  pace_.emplace(parameters_.rate);
  session_begin_ = now_ = session.begin();
  published_ = 0;
  outlet_->publish(staticTransforms(session));
  outlet_->advance(now_);
  if (!hold("waiting for subscribers", [this] { return begin_; })) return false;
  while (const std::optional<Session::Arrival> arrival = session.next()) {
    const StampNs taken = arrival->taken;
    if (!hold("running", [&] { return pace_->due(taken, Clock::now()); })) return false;
    publish(messages.convert(arrival->measurement), taken);
  }
  const StampNs end = session.begin() + static_cast<StampNs>(1e9 * session.duration());
  outlet_->advance(end);
  now_ = end;
  return true;
}

void SimulatorNodelet::publish(const std::vector<TopicMessage>& messages, StampNs taken) {
  now_ = taken;
  outlet_->advance(taken);
  for (const TopicMessage& message : messages) outlet_->publish(message);
  published_ += static_cast<std::int64_t>(messages.size());
  pace_->passed(taken, Clock::now());
  report("running", taken);
  if (slowness_reported_ || !pace_->isSlow()) return;
  slowness_reported_ = true;
  NODELET_WARN(
      "the simulation runs at %.2f times real time, not at %g: time follows what has been rendered; fewer "
      "sensors render faster",
      *pace_->factor(), parameters_.rate);
}

/// Waits until `due()`, including pauses; returns false to stop the session.
template <typename Due>
bool SimulatorNodelet::hold(const char* state, const Due& due) {
  while (true) {
    switch (orders_.wait(due(), kTick)) {
      case PlaybackControl::Answer::Go: return true;
      case PlaybackControl::Answer::End: return false;
      case PlaybackControl::Answer::Wait: report(state, now_); break;
      case PlaybackControl::Answer::Paused:
        pace_->restart();
        report("paused", now_);
        break;
    }
    outlet_->repeatClock();
  }
}

void SimulatorNodelet::report(const char* state, StampNs taken) {
  Progress progress;
  progress.state = state;
  progress.time = 1e-9 * static_cast<double>(taken - session_begin_);
  if (pace_) {
    progress.factor = pace_->factor();
    progress.slow = pace_->isSlow();
  }
  progress.messages = published_;
  diagnostics_->report(progress);
}

}  // namespace urban_nav_sim

PLUGINLIB_EXPORT_CLASS(urban_nav_sim::SimulatorNodelet, nodelet::Nodelet)
