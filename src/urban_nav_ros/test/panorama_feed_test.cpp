// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/panorama_feed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kFeedMs = 1'000'000;

RecordedImage panoramaImage(StampNs stamp, int value) {
  auto message = boost::make_shared<sensor_msgs::Image>(toImageMessage(cv::Mat(4, 6, CV_8UC1, cv::Scalar(value))));
  message->header.stamp = toRosTime(stamp);
  message->header.frame_id = "camera" + std::to_string(value);
  return RecordedImage(sensor_msgs::ImageConstPtr(message));
}

RecordedImage colourJpeg(StampNs stamp) {
  auto message = boost::make_shared<sensor_msgs::CompressedImage>();
  message->header.stamp = toRosTime(stamp);
  message->format = "jpeg";
  cv::imencode(".png", cv::Mat(4, 6, CV_8UC3, cv::Scalar(10, 20, 200)), message->data);
  return RecordedImage(sensor_msgs::CompressedImageConstPtr(message));
}

std::vector<Panorama> takeAll(PanoramaFeed& feed) {
  std::vector<Panorama> panoramas;
  while (auto panorama = feed.take()) panoramas.push_back(std::move(*panorama));
  return panoramas;
}

struct PanoramaArrival {
  StampNs arrival = 0, stamp = 0;
  std::size_t camera = 0;
};

std::vector<PanoramaArrival> shuffledArrivals(unsigned seed, std::size_t without_camera = 99) {
  std::mt19937 random(seed);
  std::vector<PanoramaArrival> all;
  for (StampNs t = 1000; t < 6000; t += 500)
    for (std::size_t camera = 0; camera < 5; ++camera)
      if (camera != without_camera)
        all.push_back({t + static_cast<StampNs>(random() % 150), t + static_cast<StampNs>(random() % 5), camera});
  std::stable_sort(all.begin(), all.end(),
                   [](const PanoramaArrival& a, const PanoramaArrival& b) { return a.arrival < b.arrival; });
  return all;
}

TEST(PanoramaFeed, GroupsShuffledImagesByStamp) {
  PanoramaFeed feed({});
  std::vector<Panorama> panoramas;
  for (const PanoramaArrival& image : shuffledArrivals(1)) {
    feed.add(image.camera, panoramaImage(image.stamp * kFeedMs, static_cast<int>(image.camera)));
    for (Panorama& panorama : takeAll(feed)) panoramas.push_back(std::move(panorama));
  }
  feed.finish();
  for (Panorama& panorama : takeAll(feed)) panoramas.push_back(std::move(panorama));
  ASSERT_EQ(panoramas.size(), 10U);
  for (std::size_t i = 0; i < panoramas.size(); ++i) {
    StampNs earliest = panoramas[i].images[0].stamp();
    for (std::size_t camera = 0; camera < 5; ++camera) {
      EXPECT_EQ(panoramas[i].images[camera].grey().pixels.at<std::uint8_t>(0, 0), camera);
      EXPECT_EQ(panoramas[i].images[camera].frame(), "camera" + std::to_string(camera));
      earliest = std::min(earliest, panoramas[i].images[camera].stamp());
    }
    EXPECT_EQ(panoramas[i].stamp, earliest);
    EXPECT_EQ(panoramas[i].stamp / (500 * kFeedMs), static_cast<StampNs>(i) + 2);
  }
}

TEST(PanoramaFeed, LeavesOutACameraThatIsDead) {
  PanoramaFeed feed({});
  std::size_t panoramas = 0;
  for (const PanoramaArrival& image : shuffledArrivals(2, 3)) {
    feed.add(image.camera, panoramaImage(image.stamp * kFeedMs, 7));
    panoramas += takeAll(feed).size();
  }
  EXPECT_GE(panoramas, 8U) << "known to be incomplete when the next one arrives";
  feed.finish();
  panoramas += takeAll(feed).size();
  EXPECT_EQ(panoramas, 10U);
  EXPECT_EQ(feed.missing(3), 10);
  EXPECT_EQ(feed.missing(2), 0);
}

TEST(PanoramaFeed, ContinuesFromItsArchivedState) {
  const std::vector<PanoramaArrival> arrivals = shuffledArrivals(3, 1);
  for (std::size_t cut = 0; cut <= arrivals.size(); cut += 7) {
    std::vector<StampNs> stamps;
    auto feed = std::make_unique<PanoramaFeed>(PanoramaFeed::Options{});
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
      if (i == cut) {
        urban_nav_core::Archive writer;
        feed->archive(writer);
        const std::string bytes = writer.take();
        feed = std::make_unique<PanoramaFeed>(PanoramaFeed::Options{});
        urban_nav_core::Archive reader(bytes, "feed");
        feed->archive(reader);
        reader.finish();
      }
      feed->add(arrivals[i].camera, panoramaImage(arrivals[i].stamp * kFeedMs, 1));
      for (const Panorama& panorama : takeAll(*feed)) stamps.push_back(panorama.stamp);
    }
    feed->finish();
    for (const Panorama& panorama : takeAll(*feed)) stamps.push_back(panorama.stamp);
    EXPECT_EQ(stamps.size(), 10U) << cut;
    EXPECT_TRUE(std::is_sorted(stamps.begin(), stamps.end()));
    EXPECT_EQ(feed->missing(1), 10);
  }
}

RecordedImage deepImage(StampNs stamp, std::uint16_t value) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = toRosTime(stamp);
  message->encoding = "mono16";
  message->height = message->width = 16;
  message->step = 32;
  for (int i = 0; i < 256; ++i)
    for (const int byte : {value & 255, value >> 8}) message->data.push_back(static_cast<std::uint8_t>(byte));
  return RecordedImage(sensor_msgs::ImageConstPtr(message));
}

TEST(PanoramaFeed, ShowsSixteenBitsOfAllCamerasByOneScale) {
  PanoramaFeed::Options options;
  options.cameras = 2;
  PanoramaFeed feed(options);
  feed.add(0, deepImage(1000 * kFeedMs, 1000));
  feed.add(1, deepImage(1000 * kFeedMs, 4000));
  feed.finish();
  const std::optional<Panorama> panorama = feed.take();
  ASSERT_TRUE(panorama);
  EXPECT_EQ(panorama->images[0].grey().pixels.at<std::uint8_t>(0, 0), 1000 / 16);
  EXPECT_EQ(panorama->images[1].grey().pixels.at<std::uint8_t>(0, 0), 4000 / 16);
  EXPECT_EQ(panorama->images[1].colour().pixels.at<cv::Vec3b>(0, 0), cv::Vec3b(250, 250, 250));
  urban_nav_core::Archive writer;
  RecordedImage image = panorama->images[0];
  writer(image);
  const std::string bytes = writer.take();
  urban_nav_core::Archive reader(bytes, "image");
  RecordedImage read;
  reader(read);
  EXPECT_EQ(read.grey().pixels.at<std::uint8_t>(0, 0), 1000 / 16);
}

TEST(RecordedImage, DecodesColourAndGreyOnDemand) {
  const RecordedImage jpeg = colourJpeg(5 * kFeedMs);
  EXPECT_EQ(jpeg.stamp(), 5 * kFeedMs);
  const ColourImage colour = jpeg.colour();
  ASSERT_EQ(colour.pixels.type(), CV_8UC3);
  EXPECT_EQ(colour.pixels.at<cv::Vec3b>(2, 2), cv::Vec3b(10, 20, 200));
  EXPECT_EQ(jpeg.grey().pixels.type(), CV_8UC1);
  EXPECT_EQ(panoramaImage(1, 9).colour().pixels.at<cv::Vec3b>(1, 1), cv::Vec3b(9, 9, 9));
  auto rgb = boost::make_shared<sensor_msgs::Image>(toColourImageMessage(cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3))));
  rgb->encoding = "rgb8";
  EXPECT_EQ(RecordedImage(sensor_msgs::ImageConstPtr(rgb)).colour().pixels.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 2, 1));
}

TEST(RecordedImage, ReportsWhatDoesNotDecode) {
  auto broken = boost::make_shared<sensor_msgs::CompressedImage>();
  broken->data = {1, 2, 3};
  const RecordedImage image{sensor_msgs::CompressedImageConstPtr(broken)};
  EXPECT_FALSE(image.grey().fault.empty());
  EXPECT_FALSE(image.colour().fault.empty());
  EXPECT_FALSE(RecordedImage().grey().fault.empty());
  EXPECT_TRUE(RecordedImage().empty());
}

}  // namespace
}  // namespace urban_nav_ros
