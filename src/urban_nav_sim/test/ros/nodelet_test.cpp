// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_sim/ros/measurement_messages.hpp"

namespace urban_nav_sim::test {
namespace {

using urban_nav_core::StampNs;

/// As in nodelet.test.
SessionOptions sameSession() {
  SessionOptions options;
  options.seed = 3;
  options.duration = 1.0;
  options.sensors = {Sensor::Stereo, Sensor::Lasers, Sensor::Imu};
  options.faults = {parseFault("unplug:lasers:0.5:9")};
  return options;
}

/// Returns the content of a message without header.seq, which the publisher sets.
template <typename Message>
std::vector<std::uint8_t> toBytes(Message message) {
  message.header.seq = 0;
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

/// A listener that keeps everything, and the services.
class Simulator : public ::testing::Test {
 protected:
  struct Received {
    StampNs stamp;
    std::vector<std::uint8_t> bytes;
  };

  /// Held at the beginning of the session. The other topics are subscribed to then: on a new connection comes nothing
  /// from the session before, which a busy machine may still be sending.
  void SetUp() override {
    ASSERT_TRUE(call("pause"));
    subscribers_.push_back(nh_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
          for (const auto& status : message->status) diagnostics_.push_back(status);
        }));
    ASSERT_TRUE(call("reset"));
    ASSERT_TRUE(until([this] { return said("paused") && published() == 0; })) << lastState();
    for (const TopicMessage& each : listTopics(sameSession().sensors))
      std::visit([&](const auto& pointer) { keep(each.topic, *pointer); }, each.message);
    subscribers_.push_back(
        nh_.subscribe<rosgraph_msgs::Clock>("/clock", 10000, [this](const rosgraph_msgs::ClockConstPtr& message) {
          clock_.push_back(urban_nav_ros::toStampNs(message->clock));
        }));
    ASSERT_TRUE(until([this] {
      return std::all_of(subscribers_.begin(), subscribers_.end(),
                         [](const ros::Subscriber& each) { return each.getNumPublishers() > 0; });
    }));
    ASSERT_TRUE(until([this] { return !clock_.empty() && clock_.back() == begin(); })) << lastState();
    diagnostics_.clear();
  }

  static StampNs begin() {
    static const StampNs stamp = Session(sameSession()).begin();
    return stamp;
  }

  static bool call(const std::string& service) {
    std_srvs::Trigger trigger;
    ros::service::waitForService("simulator/" + service, ros::Duration(-1.0));
    return ros::service::call("simulator/" + service, trigger) && trigger.response.success;
  }

  static bool until(const std::function<bool()>& so) { return urban_nav_ros::testing::Listener::until(so); }

  /// Whether the newest status has it.
  bool said(const std::string& state) const {
    return !diagnostics_.empty() && diagnostics_.back().message.find(state) == 0;
  }
  /// Number of messages of this session by the newest status.
  std::size_t published() const {
    for (const auto& each : diagnostics_.back().values)
      if (each.key == "messages") return std::stoul(each.value);
    return std::string::npos;
  }
  std::size_t received() const {
    std::size_t all = 0;
    for (const auto& [topic, messages] : received_) all += messages.size();
    return all;
  }
  /// Whether all that has been published has come. Messages on different connections overtake each other.
  bool receivedAll() const { return !diagnostics_.empty() && received() == published(); }
  std::string lastState() const { return diagnostics_.empty() ? "no diagnostics" : diagnostics_.back().message; }

  template <typename Message>
  void keep(const std::string& topic, const Message&) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, topic](const boost::shared_ptr<const Message>& message) {
          received_[topic].push_back({urban_nav_ros::toStampNs(message->header.stamp), toBytes(*message)});
        };
    subscribers_.push_back(nh_.subscribe<Message>(topic, 10000, callback));
  }

  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
  std::map<std::string, std::vector<Received>> received_;
  std::vector<StampNs> clock_;
  std::vector<diagnostic_msgs::DiagnosticStatus> diagnostics_;
};

TEST_F(Simulator, PublishesTheSessionToTheLastBit) {
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> expected;
  Session session(sameSession());
  MeasurementMessages messages(session);
  while (const auto arrival = session.next())
    for (const TopicMessage& each : messages.convert(arrival->measurement))
      std::visit([&](const auto& pointer) { expected[each.topic].push_back(toBytes(*pointer)); }, each.message);
  EXPECT_EQ(expected["stereo/left/image_raw"].size(), 20U);
  EXPECT_LT(expected["laser_left/scan"].size(), 60U) << "the fault is in force";
  ASSERT_EQ(expected.size(), listTopics(sameSession().sensors).size());

  ASSERT_TRUE(call("resume"));
  ASSERT_TRUE(until([this] { return said("over") && receivedAll(); })) << lastState() << ", " << received();
  for (const auto& [topic, all] : expected) {
    ASSERT_EQ(received_[topic].size(), all.size()) << topic;
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(received_[topic][i].bytes, all[i]) << topic << " " << i;
  }
}

TEST_F(Simulator, TheClockFollowsTheMessagesAndTheDiagnosticsReportIt) {
  ASSERT_TRUE(call("resume"));
  ASSERT_TRUE(until([this] { return said("over") && receivedAll(); })) << lastState() << ", " << received();
  ASSERT_TRUE(until([this] { return clock_.back() == begin() + 1'000'000'000; })) << "the end of the session";
  EXPECT_TRUE(std::is_sorted(clock_.begin(), clock_.end()));
  EXPECT_GE(clock_.size(), 150U);
  // No listener knows which /clock came before which message: they have connections of their own.
  for (const Received& truth : received_["ground_truth/pose"]) {
    const auto next = std::lower_bound(clock_.begin(), clock_.end(), truth.stamp);
    ASSERT_NE(next, clock_.end());
    EXPECT_LE(*next - truth.stamp, 100'000'000) << "ns";
  }

  std::map<std::string, std::string> values;
  for (const auto& each : diagnostics_.back().values) values[each.key] = each.value;
  EXPECT_EQ(values["session"], "quad, seed 3, route loops, day 1");
  EXPECT_EQ(values["time (s)"], "1.00");
  EXPECT_EQ(values["duration (s)"], "1.00");
  EXPECT_NE(values["time factor"], "");
  const std::size_t end = received_["ground_truth/pose"].size();
  EXPECT_GT(std::stoul(values["messages"]), end) << "of this session, not of those before";
  EXPECT_LT(std::stoul(values["messages"]), 4 * end);
}

TEST_F(Simulator, PausesAndGoesOn) {
  ASSERT_TRUE(until([this] { return clock_.size() >= 3; })) << "the clock is said while it stands";
  EXPECT_EQ(clock_.front(), clock_.back());
  EXPECT_TRUE(received_["ground_truth/pose"].empty());
  ASSERT_TRUE(call("resume"));
  ASSERT_TRUE(until([this] { return received_["stereo/left/image_raw"].size() >= 3; }));
  ASSERT_TRUE(call("pause"));
  ASSERT_TRUE(until([this] { return said("paused") && receivedAll(); })) << lastState() << ", " << received();
  const std::size_t before = received(), clocks = clock_.size();
  ASSERT_TRUE(until([&] { return clock_.size() >= clocks + 3; })) << "the clock is repeated";
  EXPECT_EQ(received(), before);
  EXPECT_EQ(clock_[clocks], clock_.back());
  ASSERT_TRUE(call("resume"));
  ASSERT_TRUE(until([this] { return received_["stereo/left/image_raw"].size() == 20; }))
      << received_["stereo/left/image_raw"].size();
}

TEST_F(Simulator, ItsFramesHangTogether) {
  tf2_msgs::TFMessageConstPtr message;
  const boost::function<void(const tf2_msgs::TFMessageConstPtr&)> keep_it = [&](const auto& latched) {
    message = latched;
  };
  const ros::Subscriber transforms = nh_.subscribe<tf2_msgs::TFMessage>("/tf_static", 1, keep_it);
  ASSERT_TRUE(until([&] { return message != nullptr; }));
  std::vector<std::string> frames;
  for (const auto& transform : message->transforms) {
    EXPECT_EQ(transform.header.frame_id, "base_link");
    frames.push_back(transform.child_frame_id);
  }
  for (const char* frame : {"stereo_left_optical_frame", "stereo_right_optical_frame", "laser_left", "laser_right",
                            "imu_link", "gps_link", "ladybug_camera0_optical_frame", "ladybug_camera4_optical_frame"})
    EXPECT_EQ(std::count(frames.begin(), frames.end(), frame), 1) << frame;
}

}  // namespace
}  // namespace urban_nav_sim::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "simulator_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
