// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_feed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <functional>
#include <random>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::CameraInfo;
using urban_nav_core::StampNs;
using urban_nav_core::StereoCamera;

constexpr int kWidth = 96, kHeight = 72;
constexpr StampNs kMs = 1'000'000;

StereoCamera camera() {
  StereoCamera camera;
  camera.left = {80.0, 80.0, 47.5, 35.5, kWidth, kHeight};
  camera.baseline = 0.12;
  return camera;
}

std::shared_ptr<const StereoCalibration> calibration() {
  return std::make_shared<StereoCalibration>(leftInfo(camera()), rightInfo(camera()), false, "test");
}

sensor_msgs::ImageConstPtr image(StampNs stamp, int value, int w = kWidth, int h = kHeight) {
  auto message = boost::make_shared<sensor_msgs::Image>(toImageMessage(cv::Mat(h, w, CV_8UC1, cv::Scalar(value))));
  message->header.stamp = toRosTime(stamp);
  return message;
}

std::vector<DecodedPair> drain(StereoFeed& feed) {
  std::vector<DecodedPair> pairs;
  while (auto pair = feed.take()) pairs.push_back(std::move(*pair));
  return pairs;
}

TEST(StereoFeed, ABagShuffledWithinTheLatenessGivesTheSamePairs) {
  struct Message {
    double arrival;
    Side side;
    StampNs stamp;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> delay(0.0, 50.0);
  for (const bool shuffled : {false, true}) {
    std::vector<Message> messages;
    for (StampNs t = 1000; t < 3000; t += 40) {
      messages.push_back({static_cast<double>(t) + (shuffled ? delay(random) : 0.0), Side::Left, t * kMs});
      messages.push_back({static_cast<double>(t) + (shuffled ? delay(random) : 0.0), Side::Right, t * kMs});
    }
    std::stable_sort(messages.begin(), messages.end(),
                     [](const Message& a, const Message& b) { return a.arrival < b.arrival; });
    StereoFeed feed(StereoFeed::Options(), calibration());
    std::vector<DecodedPair> pairs;
    for (const Message& message : messages) {
      feed.add(message.side, image(message.stamp, message.side == Side::Left ? 10 : 20));
      for (DecodedPair& pair : drain(feed)) pairs.push_back(std::move(pair));
    }
    feed.finish();
    for (DecodedPair& pair : drain(feed)) pairs.push_back(std::move(pair));
    ASSERT_EQ(pairs.size(), 50U) << (shuffled ? "shuffled" : "in order");
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(pairs[i].assembled.pair.stamp, (1000 + 40 * static_cast<StampNs>(i)) * kMs);
      ASSERT_FALSE(pairs[i].assembled.pair.left.empty() || pairs[i].assembled.pair.right.empty());
      EXPECT_EQ(pairs[i].assembled.pair.left.at(3, 3), 10);
      EXPECT_EQ(pairs[i].assembled.pair.right.at(3, 3), 20);
    }
  }
}

TEST(StereoFeed, LiveAPairLeavesWithItsSecondImage) {
  StereoFeed::Options options;
  options.delivery = urban_nav_core::DeliveryOrder::OrderedStreams;
  StereoFeed feed(options, calibration());
  feed.add(Side::Left, image(1000 * kMs, 1));
  EXPECT_TRUE(drain(feed).empty());
  feed.add(Side::Right, image(1000 * kMs, 2));
  EXPECT_EQ(drain(feed).size(), 1U);
}

TEST(StereoFeed, AMissingOrDamagedImageIsReportedByItsPair) {
  StereoFeed feed(StereoFeed::Options(), calibration());
  feed.add(Side::Left, image(1000 * kMs, 1));
  feed.add(Side::Left, image(1100 * kMs, 1));
  feed.add(Side::Right, image(1100 * kMs, 1, 50, 50));
  auto damaged = boost::make_shared<sensor_msgs::Image>(*image(1200 * kMs, 1));
  damaged->data.resize(100);
  feed.add(Side::Left, image(1200 * kMs, 1));
  feed.add(Side::Right, sensor_msgs::ImageConstPtr(damaged));
  feed.finish();
  const std::vector<DecodedPair> pairs = drain(feed);
  ASSERT_EQ(pairs.size(), 3U);
  for (const DecodedPair& pair : pairs) {
    EXPECT_FALSE(pair.assembled.pair.left.empty());
    EXPECT_TRUE(pair.assembled.pair.right.empty());
  }
  EXPECT_EQ(feed.missing(Side::Right), 1);
  EXPECT_EQ(feed.missing(Side::Left), 0);
  ASSERT_EQ(pairs[1].faults.size(), 1U);
  EXPECT_NE(pairs[1].faults[0].find("right image: 50x50"), std::string::npos) << pairs[1].faults[0];
  ASSERT_EQ(pairs[2].faults.size(), 1U);
  EXPECT_NE(pairs[2].faults[0].find("right image: 100 bytes"), std::string::npos) << pairs[2].faults[0];
}

TEST(StereoFeed, RawImagesAreRectified) {
  CameraInfo left = leftInfo(camera()), right = rightInfo(camera());
  left.distortion_model = right.distortion_model = "plumb_bob";
  left.D = right.D = {-0.2, 0.0, 0.0, 0.0, 0.0};
  cv::Mat picture(kHeight, kWidth, CV_8UC1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) picture.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(2 * u);
  auto message = boost::make_shared<sensor_msgs::Image>(toImageMessage(picture));
  message->header.stamp = toRosTime(1000 * kMs);
  for (const bool rectified_already : {false, true}) {
    StereoFeed feed(StereoFeed::Options(), std::make_shared<StereoCalibration>(left, right, rectified_already, "test"));
    feed.add(Side::Left, sensor_msgs::ImageConstPtr(message));
    feed.add(Side::Right, sensor_msgs::ImageConstPtr(message));
    feed.finish();
    const std::vector<DecodedPair> pairs = drain(feed);
    ASSERT_EQ(pairs.size(), 1U);
    const int seen = pairs[0].assembled.pair.left.at(87, 35);
    // A ray at x = (87 - 47.5) / 80 is at x (1 - 0.2 x^2) in the raw image.
    const double x = (87 - 47.5) / 80.0, raw = 47.5 + 80.0 * x * (1.0 - 0.2 * x * x);
    EXPECT_NEAR(seen, rectified_already ? 2 * 87 : 2 * raw, 1.5);
  }
}

TEST(StereoFeed, MotionComesWithThePairThatItLeadsTo) {
  StereoFeed::Options options;
  options.motion.wheels = true;
  StereoFeed feed(options, calibration());
  for (StampNs t = 0; t < 10; ++t) {
    urban_nav_core::MotionInput input;
    input.from = (1000 + 20 * t) * kMs;
    input.to = input.from + 20 * kMs;
    feed.add(input);
  }
  for (StampNs t = 1000; t < 1200; t += 50) {
    feed.add(Side::Right, image(t * kMs, 1));
    feed.add(Side::Left, image(t * kMs, 1));
  }
  feed.finish();
  const std::vector<DecodedPair> pairs = drain(feed);
  ASSERT_EQ(pairs.size(), 4U);
  EXPECT_EQ(pairs[0].assembled.inputs.size(), 0U);
  EXPECT_EQ(pairs[1].assembled.inputs.size(), 2U);
  EXPECT_EQ(pairs[2].assembled.inputs.size(), 3U);
  EXPECT_EQ(pairs[3].assembled.inputs.size(), 2U);
}

TEST(StereoCalibration, APairThatIsNoneIsTheUsersMistake) {
  EXPECT_THROW(StereoCalibration(rightInfo(camera()), leftInfo(camera()), false, "topics"), urban_nav_core::UserError);
  EXPECT_THROW(StereoCalibration(CameraInfo(), CameraInfo(), false, "topics"), urban_nav_core::UserError);
}

TEST(CameraInfo, ThereAndBack) {
  CameraInfo info = rightInfo(camera());
  info.distortion_model = "plumb_bob";
  info.D = {0.1, 0.2, 0.3, 0.4, 0.5};
  const CameraInfo back = toCameraInfo(toCameraInfoMessage(info));
  EXPECT_EQ(back.width, info.width);
  EXPECT_EQ(back.height, info.height);
  EXPECT_EQ(back.D, info.D);
  EXPECT_EQ(back.distortion_model, info.distortion_model);
  EXPECT_EQ(back.K, info.K);
  EXPECT_EQ(back.R, info.R);
  EXPECT_EQ(back.P, info.P);
}

TEST(CameraInfo, BinningAndRegionOfInterestScaleTheProjection) {
  CameraInfo info = rightInfo(camera());
  sensor_msgs::CameraInfo message = toCameraInfoMessage(info);
  message.binning_x = message.binning_y = 2;
  message.roi.x_offset = 4;
  message.roi.y_offset = 6;
  message.roi.width = message.width - 8;
  message.roi.height = message.height - 12;
  const CameraInfo binned = toCameraInfo(message);
  EXPECT_EQ(binned.width, static_cast<int>(message.roi.width / 2));
  const Eigen::Vector4d X(0.3, -0.2, 2.0, 1.0);
  const Eigen::Vector3d full = info.P * X, small = binned.P * X;
  EXPECT_NEAR(small.x() / small.z(), (full.x() / full.z() - 4.0) / 2.0, 1e-12);
  EXPECT_NEAR(small.y() / small.z(), (full.y() / full.z() - 6.0) / 2.0, 1e-12);
  EXPECT_NEAR(binned.K(0, 0), info.K(0, 0) / 2.0, 1e-12);
}

TEST(CameraInfo, AProjectionAloneIsOfARectifiedCamera) {
  sensor_msgs::CameraInfo message = toCameraInfoMessage(rightInfo(camera()));
  message.K.fill(0.0);
  message.R.fill(0.0);
  message.D.clear();
  const CameraInfo info = toCameraInfo(message);
  EXPECT_FALSE(needsRectification(info));
  EXPECT_EQ(info.K, info.P.leftCols<3>());
}

/// Output of a feed: stamps, pixels, inputs, faults.
std::string toText(const std::vector<DecodedPair>& pairs) {
  std::string text;
  const auto add = [&](const urban_nav_core::ImageView& view) {
    text += " " + (view.empty() ? std::string("none")
                                : std::to_string(view.at(3, 3)) + "/" + std::to_string(view.at(95, 71)));
  };
  for (const DecodedPair& pair : pairs) {
    text += std::to_string(pair.assembled.pair.stamp);
    add(pair.assembled.pair.left);
    add(pair.assembled.pair.right);
    for (const urban_nav_core::MotionInput& input : pair.assembled.inputs)
      text += " motion " + std::to_string(input.to);
    for (const std::string& fault : pair.faults) text += " " + fault;
    text += "\n";
  }
  return text;
}

// The feed is archived between any two messages and continued in another object: results are those of one object.
TEST(StereoFeed, GoesOnFromItsState) {
  StereoFeed::Options options;
  options.motion.wheels = true;
  std::vector<std::function<void(StereoFeed&)>> messages;
  for (StampNs i = 0; i < 30; ++i) {
    const StampNs stamp = (1000 + 20 * i) * kMs;
    auto left = boost::make_shared<sensor_msgs::Image>(*image(stamp, static_cast<int>(5 + i)));
    if (i == 11) left->data.resize(100);  // damaged
    urban_nav_core::MotionInput motion;
    motion.from = stamp - 20 * kMs;
    motion.to = stamp - 3 * kMs;
    messages.push_back([left](StereoFeed& feed) { feed.add(Side::Left, sensor_msgs::ImageConstPtr(left)); });
    messages.push_back([motion](StereoFeed& feed) { feed.add(motion); });
    if (i != 7)
      messages.push_back([i, stamp](StereoFeed& feed) { feed.add(Side::Right, image(stamp - (i % 3) * kMs, 99)); });
    if (i == 20) messages.push_back([](StereoFeed& feed) { feed.add(Side::Right, image(1000 * kMs, 99)); });  // late
  }
  const auto play = [&](std::size_t cut) {
    std::vector<DecodedPair> pairs;
    auto feed = std::make_unique<StereoFeed>(options, calibration());
    for (std::size_t i = 0; i <= messages.size(); ++i) {
      for (DecodedPair& pair : drain(*feed)) pairs.push_back(std::move(pair));
      if (i == cut) {
        urban_nav_core::Archive writer;
        feed->archive(writer);
        const std::string state = writer.take();
        feed = std::make_unique<StereoFeed>(options, calibration());
        urban_nav_core::Archive reader(state, "state");
        feed->archive(reader);
        reader.finish();
        EXPECT_TRUE(drain(*feed).empty());
      }
      if (i < messages.size()) messages[i](*feed);
    }
    feed->finish();
    for (DecodedPair& pair : drain(*feed)) pairs.push_back(std::move(pair));
    return toText(pairs) + std::to_string(feed->missing(Side::Right)) + " " +
           std::to_string(feed->counts(Side::Right).late) + " " + std::to_string(feed->counts(Side::Left).received);
  };
  const std::string whole = play(messages.size() + 1);
  EXPECT_NE(whole.find("none"), std::string::npos) << "otherwise the test is not meaningful";
  EXPECT_NE(whole.find("motion"), std::string::npos);
  for (std::size_t cut = 0; cut < messages.size(); ++cut) EXPECT_EQ(play(cut), whole) << "cut before message " << cut;
}

TEST(StereoFeed, WaitingImagesAreArchivedExactlyAndPacked) {
  constexpr StampNs kStamp = 5000 * kMs;
  auto left = boost::make_shared<sensor_msgs::Image>(*image(kStamp, 0)),
       right = boost::make_shared<sensor_msgs::Image>();
  for (std::size_t i = 0; i < left->data.size(); ++i) left->data[i] = static_cast<std::uint8_t>(i % kWidth + i / 50);
  *right = *left;
  right->step += 8;  // rows with gaps are stored as they are
  right->data.resize(right->step * right->height, 3);
  StereoFeed feed(StereoFeed::Options(), calibration());
  feed.add(Side::Left, sensor_msgs::ImageConstPtr(left));
  urban_nav_core::Archive one;
  feed.archive(one);
  const std::size_t size = one.take().size();
  EXPECT_LT(size, left->data.size() / 2) << "they are stored as PNG";
  feed.add(Side::Right, sensor_msgs::ImageConstPtr(right));
  urban_nav_core::Archive both;
  feed.archive(both);
  const std::string bytes = both.take();
  EXPECT_GT(bytes.size(), size + right->data.size());
  StereoFeed restored(StereoFeed::Options(), calibration());
  urban_nav_core::Archive reader(bytes, "feed");
  restored.archive(reader);
  reader.finish();
  for (StereoFeed* each : {&feed, &restored}) each->finish();
  const std::vector<DecodedPair> expected = drain(feed), found = drain(restored);
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(expected.size(), 1U);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_EQ(found[0].assembled.pair.left.at(u, v), expected[0].assembled.pair.left.at(u, v));
      ASSERT_EQ(found[0].assembled.pair.right.at(u, v), expected[0].assembled.pair.right.at(u, v));
    }
}

}  // namespace
}  // namespace urban_nav_ros
