// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/PlaceBelief.h>
#include <urban_nav_msgs/TopologicalClosure.h>
#include <visualization_msgs/MarkerArray.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>

#include "../support/square_images.hpp"
#include "../support/temporary_folder.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/receipts.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace fabmap_node::test {
namespace {

using testing::drawSquares;
using testing::TemporaryFolder;
using urban_nav_core::StampNs;

constexpr StampNs kFirstStamp = 1'225'719'873'000'000'000, kHalfSecond = 500'000'000;
constexpr int kHeadCameras = 5;

/// Returns the number of places in a store from a stamp on; 0 without a store.
std::size_t countPlaces(const std::string& path, StampNs from) {
  try {
    urban_nav_store::Store store(path, urban_nav_store::Access::Read);
    std::size_t count = 0;
    for (const auto& session : store.sessions().all())
      urban_nav_store::TableStore<urban_nav_store::StoredPlace>(store).forEach(
          session.id, [&](const auto& row) { count += row.stamp >= from ? 1 : 0; });
    return count;
  } catch (const urban_nav_core::Error&) {
    return 0;
  }
}

/// Returns the process of a node, from its slave API; 0 if it does not answer.
pid_t findProcess(const std::string& node) {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = request[1] = node;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", request, response, uri, false) ||
      !ros::network::splitURI(std::string(uri), host, port))
    return 0;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller, answer;
  caller[0] = ros::this_node::getName();
  if (!client.execute("getPid", caller, answer) || answer.size() != 3) return 0;
  return static_cast<int>(answer[2]);
}

/// Panoramic head on topics, and a subscriber to those of the nodelet.
class Head {
 public:
  Head() {
    for (int camera = 0; camera < kHeadCameras; ++camera)
      images_.push_back(
          nh_.advertise<sensor_msgs::Image>("ladybug/camera" + std::to_string(camera) + "/image_raw", 100));
    odometry_ = nh_.advertise<nav_msgs::Odometry>("odometry", 100);
    metric_ = nh_.advertise<urban_nav_msgs::MetricClosure>("loops/metric", 100);
    graph_ = nh_.advertise<urban_nav_msgs::MetricClosure>("graph/verdicts", 100);
    belief_ = nh_.subscribe<urban_nav_msgs::PlaceBelief>(
        "places/belief", 100, [this](const urban_nav_msgs::PlaceBeliefConstPtr& m) { beliefs.push_back(*m); });
    closure_ = nh_.subscribe<urban_nav_msgs::TopologicalClosure>(
        "places/closure", 100, [this](const urban_nav_msgs::TopologicalClosureConstPtr& m) { closures.push_back(*m); });
    marker_ = nh_.subscribe<visualization_msgs::MarkerArray>(
        "places/markers", 100, [this](const visualization_msgs::MarkerArrayConstPtr& m) { markers = m->markers; });
  }
  static bool until(const std::function<bool()>& isDone) { return urban_nav_ros::testing::Listener::until(isDone); }
  bool connected() {
    return until([this] {
      for (const ros::Publisher& image : images_)
        if (image.getNumSubscribers() == 0) return false;
      for (const ros::Publisher* other : {&odometry_, &metric_, &graph_})
        if (other->getNumSubscribers() == 0) return false;
      return belief_.getNumPublishers() > 0 && closure_.getNumPublishers() > 0 && marker_.getNumPublishers() > 0;
    });
  }
  void show(unsigned place, StampNs stamp, int without_camera = -1) {
    for (int camera = 0; camera < kHeadCameras; ++camera) {
      if (camera == without_camera) continue;
      sensor_msgs::Image message = urban_nav_ros::toImageMessage(drawSquares(place, static_cast<unsigned>(camera)));
      message.header.stamp = urban_nav_ros::toRosTime(stamp);
      images_[static_cast<std::size_t>(camera)].publish(message);
    }
  }
  bool hasBelief(StampNs stamp) const {
    return std::any_of(beliefs.begin(), beliefs.end(),
                       [&](const auto& belief) { return urban_nav_ros::toStampNs(belief.header.stamp) == stamp; });
  }
  /// Shows a place and waits for its belief, because images of different topics may overtake each other.
  bool observe(unsigned place, StampNs stamp) {
    show(place, stamp);
    return until([&] { return hasBelief(stamp); });
  }
  bool disconnected() {
    return until([this] { return odometry_.getNumSubscribers() == 0 && images_.back().getNumSubscribers() == 0; });
  }
  void drive(StampNs stamp, double x = 0.0) {
    nav_msgs::Odometry message;
    message.header.stamp = urban_nav_ros::toRosTime(stamp);
    message.header.frame_id = "odom";
    message.pose.pose.position.x = x;
    message.pose.pose.orientation.w = 1.0;
    odometry_.publish(message);
  }
  /// Publishes the verdict of loop_metric or pose_graph on a closure.
  void verify(const urban_nav_msgs::TopologicalClosure& closure, std::uint8_t verdict, const std::string& source) {
    urban_nav_msgs::MetricClosure message;
    message.header = closure.header;
    message.a = closure.a;
    message.b = closure.b;
    message.T_a_b.orientation.w = 1.0;
    message.verdict = verdict;
    message.method = urban_nav_msgs::MetricClosure::STEREO;
    message.source = source;
    (source == "pose_graph" ? graph_ : metric_).publish(message);
  }
  /// Resets the nodelet, and drops the messages received from it.
  bool reset() {
    std_srvs::Trigger call;
    const bool done = ros::service::call("fabmap_node/reset", call) && call.response.success;
    EXPECT_TRUE(urban_nav_ros::testing::Receipts("fabmap_node").drain({"places/belief", "places/closure"}));
    beliefs.clear();
    closures.clear();
    markers.clear();
    return done;
  }
  static urban_nav_msgs::FileCommand::Response command(const std::string& service, const std::string& path) {
    urban_nav_msgs::FileCommand call;
    call.request.path = path;
    EXPECT_TRUE(ros::service::call("fabmap_node/" + service, call));
    return call.response;
  }

  std::vector<urban_nav_msgs::PlaceBelief> beliefs;
  std::vector<urban_nav_msgs::TopologicalClosure> closures;
  std::vector<visualization_msgs::Marker> markers;  // the last ones

 private:
  ros::NodeHandle nh_;
  std::vector<ros::Publisher> images_;
  ros::Publisher odometry_, metric_, graph_;
  ros::Subscriber belief_, closure_, marker_;
};

/// One head for all tests: topics that are advertised again may lose messages.
class FabmapNodelet : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { shared_ = std::make_unique<Head>(); }
  static void TearDownTestSuite() { shared_.reset(); }
  void SetUp() override {
    ASSERT_TRUE(head.connected());
    ASSERT_TRUE(head.reset());
  }

 private:
  static std::unique_ptr<Head> shared_;

 protected:
  Head& head = *shared_;
};
std::unique_ptr<Head> FabmapNodelet::shared_;

TEST_F(FabmapNodelet, RecognisesARevisitAndProposesIt) {
  for (unsigned place = 0; place < 5; ++place) ASSERT_TRUE(head.observe(place, kFirstStamp + place * kHalfSecond));
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 5; }));
  for (const auto& belief : head.beliefs) EXPECT_TRUE(belief.places.empty()) << "nothing is older than the mask";
  head.show(3, kFirstStamp + 60 * kHalfSecond);
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 6 && !head.closures.empty(); }));
  const auto& belief = head.beliefs.back();
  ASSERT_FALSE(belief.places.empty());
  EXPECT_EQ(urban_nav_ros::toStampNs(belief.places[0].stamp), kFirstStamp + 3 * kHalfSecond);
  EXPECT_EQ(urban_nav_ros::toStampNs(head.closures[0].a.stamp), kFirstStamp + 3 * kHalfSecond);
  EXPECT_EQ(urban_nav_ros::toStampNs(head.closures[0].b.stamp), kFirstStamp + 60 * kHalfSecond);
  EXPECT_NEAR(belief.p_new + belief.probabilities[0], 1.0, 1e-9);
}

TEST_F(FabmapNodelet, VerdictsOnAClosureComeBackWithinASecond) {
  for (unsigned place = 0; place < 5; ++place) ASSERT_TRUE(head.observe(place, kFirstStamp + place * kHalfSecond));
  ASSERT_TRUE(head.observe(3, kFirstStamp + 60 * kHalfSecond));
  ASSERT_TRUE(Head::until([&] { return !head.closures.empty(); }));
  const urban_nav_msgs::TopologicalClosure closure = head.closures[0];
  const double appearance = head.beliefs.back().probabilities.at(0);
  EXPECT_EQ(head.beliefs.back().verdicts.at(0), urban_nav_msgs::PlaceBelief::NONE);
  const auto revised = [&](const std::function<void()>& publish) {
    head.beliefs.clear();
    const ros::WallTime before = ros::WallTime::now();
    publish();
    EXPECT_TRUE(Head::until([&] { return !head.beliefs.empty(); }));
    EXPECT_LT((ros::WallTime::now() - before).toSec(), 1.0);
    return head.beliefs.empty() ? urban_nav_msgs::PlaceBelief() : head.beliefs.back();
  };
  const auto rejected = revised([&] { head.verify(closure, urban_nav_msgs::MetricClosure::REJECTED, "loop_metric"); });
  ASSERT_EQ(rejected.places.size(), 1U);
  EXPECT_LT(rejected.probabilities.at(0), appearance);
  EXPECT_EQ(rejected.verdicts.at(0), urban_nav_msgs::PlaceBelief::REJECTED);
  const auto accepted = revised([&] { head.verify(closure, urban_nav_msgs::MetricClosure::ACCEPTED, "loop_metric"); });
  ASSERT_EQ(accepted.places.size(), 1U);
  EXPECT_EQ(accepted.header.stamp, closure.b.stamp);
  EXPECT_EQ(accepted.places[0].stamp, closure.a.stamp);
  EXPECT_EQ(accepted.knowledge, urban_nav_msgs::PlaceBelief::KNOWN);
  EXPECT_EQ(accepted.verdicts.at(0), urban_nav_msgs::PlaceBelief::ACCEPTED);
  const auto withdrawn = revised([&] { head.verify(closure, urban_nav_msgs::MetricClosure::REJECTED, "pose_graph"); });
  ASSERT_EQ(withdrawn.places.size(), 1U);
  EXPECT_LT(withdrawn.probabilities.at(0), appearance) << "still KNOWN where appearance alone is surer than that";
  EXPECT_LT(withdrawn.probabilities.at(0), accepted.probabilities.at(0));
  EXPECT_EQ(withdrawn.verdicts.at(0), urban_nav_msgs::PlaceBelief::WITHDRAWN);
}

TEST_F(FabmapNodelet, ClearsOnResetAndContinuesWithFourCameras) {
  // More than max_lateness apart, but too little to be a backward jump.
  const auto toStamp = [](unsigned place) { return kFirstStamp + place * 300'000'000LL; };
  for (unsigned place = 10; place < 15; ++place) {
    head.show(place, toStamp(place), 2);
    if (place < 12) continue;
    ASSERT_TRUE(Head::until([&] { return head.hasBelief(toStamp(place - 2)); })) << "the others may be completed";
  }
  // With all cameras: once it is published, all earlier images have been received.
  ASSERT_TRUE(head.observe(15, toStamp(15)));
  EXPECT_EQ(head.beliefs.size(), 6U);
  for (const auto& belief : head.beliefs) EXPECT_EQ(belief.observation, "used");
}

TEST_F(FabmapNodelet, RecognisesPlacesOfASessionThatWasSaved) {
  const TemporaryFolder folder;
  const std::string path = folder.file("places.db");
  EXPECT_FALSE(Head::command("save", path).success) << "no places yet";
  for (unsigned place = 20; place < 25; ++place) ASSERT_TRUE(head.observe(place, kFirstStamp + place * kHalfSecond));
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 5; }));
  const auto saved = Head::command("save", path);
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_FALSE(Head::command("save", "relative.db").success);
  EXPECT_FALSE(Head::command("load", folder.file("absent.db")).success);
  ASSERT_TRUE(head.reset());
  const auto loaded = Head::command("load", path);
  EXPECT_TRUE(loaded.success) << loaded.message;
  ASSERT_TRUE(head.observe(22, kFirstStamp + 10'000 * kHalfSecond));
  const auto& belief = head.beliefs.back();
  ASSERT_FALSE(belief.places.empty());
  EXPECT_EQ(urban_nav_ros::toStampNs(belief.places[0].stamp), kFirstStamp + 22 * kHalfSecond);
  EXPECT_EQ(belief.places[0].session.size(), 20U) << "the id of an earlier session";
}

TEST_F(FabmapNodelet, ShowsItsBeliefAlongThePathOfOdometry) {
  const StampNs start = kFirstStamp + 15'000 * kHalfSecond;
  head.drive(start);
  for (unsigned place = 0; place < 5; ++place) ASSERT_TRUE(head.observe(40 + place, start + place * kHalfSecond));
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 5; }));
  head.drive(start + 10 * kHalfSecond, 10.0);
  head.drive(start + 50 * kHalfSecond, 11.0);
  head.show(43, start + 60 * kHalfSecond);
  head.drive(start + 60 * kHalfSecond, 20.0);
  const auto isMatch = [](const visualization_msgs::Marker& marker) { return marker.ns == "match"; };
  ASSERT_TRUE(Head::until([&] { return std::any_of(head.markers.begin(), head.markers.end(), isMatch); }));
  const auto match = std::find_if(head.markers.begin(), head.markers.end(), isMatch);
  EXPECT_EQ(match->header.frame_id, "odom");
  ASSERT_EQ(match->points.size(), 2U);
  EXPECT_DOUBLE_EQ(match->points[0].x, 20.0) << "current pose";
  EXPECT_DOUBLE_EQ(match->points[1].x, 3.0) << "pose of the earlier observation";
  std::size_t beliefs = 0;
  for (const auto& marker : head.markers)
    if (marker.ns == "KNOWN" || marker.ns == "UNSURE" || marker.ns == "NEW") beliefs += marker.points.size();
  EXPECT_EQ(beliefs, 6U);
}

TEST_F(FabmapNodelet, RecognisesPlacesCommittedBeforeItsProcessWasKilled) {
  std::string store;
  ASSERT_TRUE(ros::param::get("fabmap_node/store", store));
  const StampNs start = kFirstStamp + 20'000 * kHalfSecond;
  head.drive(start);
  for (unsigned place = 30; place < 35; ++place) ASSERT_TRUE(head.observe(place, start + place * kHalfSecond));
  ASSERT_TRUE(Head::until([&] { return countPlaces(store, start) == 5; })) << "committed without a request";
  const pid_t process = findProcess("/fabmap_node");
  ASSERT_GT(process, 0);
  ASSERT_EQ(kill(process, SIGKILL), 0);
  ASSERT_TRUE(head.disconnected());
  ASSERT_TRUE(head.connected()) << "restarted";
  head.beliefs.clear();
  ASSERT_TRUE(head.observe(32, kFirstStamp + 30'000 * kHalfSecond));
  ASSERT_FALSE(head.beliefs[0].places.empty());
  EXPECT_EQ(urban_nav_ros::toStampNs(head.beliefs[0].places[0].stamp), start + 32 * kHalfSecond);
  EXPECT_EQ(head.beliefs[0].places[0].session.size(), 20U) << "the id of an earlier session";
}

}  // namespace
}  // namespace fabmap_node::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "fabmap_node_test");
  const ros::NodeHandle alive;
  const int result = RUN_ALL_TESTS();
  std::string store;
  if (ros::param::get("fabmap_node/store", store))
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(store + suffix);
  return result;
}
