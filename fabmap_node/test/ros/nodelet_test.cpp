// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/PlaceBelief.h>
#include <urban_nav_msgs/TopologicalClosure.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <random>

#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace fabmap_node::test {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs first_stamp = 1'225'719'873'000'000'000, half_second = 500'000'000;
constexpr int head_cameras = 5;

/// Squares of random brightness: an image that no other place or camera has.
cv::Mat squaresOf(unsigned place, unsigned camera) {
  std::mt19937 random(100 * place + camera);
  cv::Mat grid(24, 32, CV_8UC1), image;
  for (int v = 0; v < grid.rows; ++v)
    for (int u = 0; u < grid.cols; ++u) grid.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random() % 256);
  cv::repeat(cv::Mat::zeros(1, 1, CV_8UC1), 240, 320, image);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) image.at<std::uint8_t>(v, u) = grid.at<std::uint8_t>(v / 10, u / 10);
  return image;
}

/// A panoramic head on topics, and a subscriber to those of the nodelet.
class Head {
 public:
  Head() {
    for (int camera = 0; camera < head_cameras; ++camera)
      images_.push_back(
          nh_.advertise<sensor_msgs::Image>("ladybug/camera" + std::to_string(camera) + "/image_raw", 100));
    belief_ = nh_.subscribe<urban_nav_msgs::PlaceBelief>(
        "places/belief", 100, [this](const urban_nav_msgs::PlaceBeliefConstPtr& m) { beliefs.push_back(*m); });
    closure_ = nh_.subscribe<urban_nav_msgs::TopologicalClosure>(
        "places/closure", 100, [this](const urban_nav_msgs::TopologicalClosureConstPtr& m) { closures.push_back(*m); });
  }
  static bool until(const std::function<bool()>& isDone) {
    for (int i = 0; i < 6000 && ros::ok() && !isDone(); ++i) {
      ros::spinOnce();
      ros::WallDuration(0.01).sleep();
    }
    return isDone();
  }
  bool connected() {
    return until([this] {
      for (const ros::Publisher& image : images_)
        if (image.getNumSubscribers() == 0) return false;
      return belief_.getNumPublishers() > 0 && closure_.getNumPublishers() > 0;
    });
  }
  void show(unsigned place, StampNs stamp, int without_camera = -1) {
    for (int camera = 0; camera < head_cameras; ++camera) {
      if (camera == without_camera) continue;
      sensor_msgs::Image message = urban_nav_ros::toImageMessage(squaresOf(place, static_cast<unsigned>(camera)));
      message.header.stamp = urban_nav_ros::toRosTime(stamp);
      images_[static_cast<std::size_t>(camera)].publish(message);
    }
  }
  bool reset() {
    std_srvs::Trigger call;
    return ros::service::call("fabmap_node/reset", call) && call.response.success;
  }
  static urban_nav_msgs::FileCommand::Response command(const std::string& service, const std::string& path) {
    urban_nav_msgs::FileCommand call;
    call.request.path = path;
    EXPECT_TRUE(ros::service::call("fabmap_node/" + service, call));
    return call.response;
  }

  std::vector<urban_nav_msgs::PlaceBelief> beliefs;
  std::vector<urban_nav_msgs::TopologicalClosure> closures;

 private:
  ros::NodeHandle nh_;
  std::vector<ros::Publisher> images_;
  ros::Subscriber belief_, closure_;
};

TEST(FabmapNodelet, recognisesARevisitAndProposesIt) {
  Head head;
  ASSERT_TRUE(head.connected());
  for (unsigned place = 0; place < 5; ++place) head.show(place, first_stamp + place * half_second);
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 5; }));
  for (const auto& belief : head.beliefs) EXPECT_TRUE(belief.places.empty()) << "nothing is older than the mask";
  head.show(3, first_stamp + 60 * half_second);
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 6 && !head.closures.empty(); }));
  const auto& belief = head.beliefs.back();
  ASSERT_FALSE(belief.places.empty());
  EXPECT_EQ(urban_nav_ros::toStampNs(belief.places[0].stamp), first_stamp + 3 * half_second);
  EXPECT_EQ(urban_nav_ros::toStampNs(head.closures[0].a.stamp), first_stamp + 3 * half_second);
  EXPECT_EQ(urban_nav_ros::toStampNs(head.closures[0].b.stamp), first_stamp + 60 * half_second);
  EXPECT_NEAR(belief.p_new + belief.probabilities[0], 1.0, 1e-9);
}

TEST(FabmapNodelet, forgetsOnResetAndContinuesWithFourCameras) {
  Head head;
  ASSERT_TRUE(head.connected());
  ASSERT_TRUE(head.reset());
  for (unsigned place = 10; place < 15; ++place) head.show(place, first_stamp + place * half_second, 2);
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() >= 3; })) << "the others may still be completed";
  for (const auto& belief : head.beliefs) EXPECT_EQ(belief.observation, "used");
}

TEST(FabmapNodelet, recognisesPlacesOfASessionThatWasSaved) {
  std::string folder = (std::filesystem::temp_directory_path() / "fabmap_node_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string path = folder + "/places.db";
  Head head;
  ASSERT_TRUE(head.connected());
  ASSERT_TRUE(head.reset());
  EXPECT_FALSE(Head::command("save", path).success) << "there are no places yet";
  for (unsigned place = 20; place < 25; ++place) head.show(place, first_stamp + place * half_second);
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 5; }));
  const auto saved = Head::command("save", path);
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_FALSE(Head::command("save", "relative.db").success);
  EXPECT_FALSE(Head::command("load", folder + "/absent.db").success);
  ASSERT_TRUE(head.reset());
  const auto loaded = Head::command("load", path);
  EXPECT_TRUE(loaded.success) << loaded.message;
  head.show(22, first_stamp + 10'000 * half_second);
  ASSERT_TRUE(Head::until([&] { return head.beliefs.size() == 6; }));
  const auto& belief = head.beliefs.back();
  ASSERT_FALSE(belief.places.empty());
  EXPECT_EQ(urban_nav_ros::toStampNs(belief.places[0].stamp), first_stamp + 22 * half_second);
  EXPECT_EQ(belief.places[0].session.size(), 20U) << "the id of an earlier session";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace fabmap_node::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "fabmap_node_test");
  const ros::NodeHandle alive;
  return RUN_ALL_TESTS();
}
