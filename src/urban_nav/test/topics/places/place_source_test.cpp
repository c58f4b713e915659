// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_source.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "support/place_images.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using testing::sceneImage;
using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_input::testing::TemporaryFolder;

void writeImage(const std::string& path, const cv::Mat& image) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  ASSERT_TRUE(cv::imwrite(path, image));
}

std::vector<PlaceImages> readAll(PlaceSource& source) {
  std::vector<PlaceImages> all;
  while (auto images = source.next()) all.push_back(std::move(*images));
  return all;
}

TEST(PlaceFolder, ReadsImagesInNameOrderASecondApart) {
  const TemporaryFolder folder;
  writeImage(folder.file("b.png"), sceneImage(2));
  writeImage(folder.file("a.png"), sceneImage(1));
  urban_nav_input::testing::writeFile(folder.file("notes.txt"), "no image");
  const auto source = openPlaceSource(folder.file(""), {});
  EXPECT_EQ(source->expected(), 2u);
  const std::vector<PlaceImages> images = readAll(*source);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0].stamp, 0);
  EXPECT_EQ(images[1].stamp, 1'000'000'000);
  ASSERT_EQ(images[0].grey.size(), 1u);
  EXPECT_EQ(cv::norm(images[0].grey[0], sceneImage(1)), 0.0);
}

TEST(PlaceFolder, TimesNeedOneLineForEachImageInAscendingOrder) {
  const TemporaryFolder folder;
  writeImage(folder.file("a.png"), sceneImage(1));
  writeImage(folder.file("b.png"), sceneImage(2));
  urban_nav_input::testing::writeFile(folder.file("times.txt"), "12.5\n13.25\n");
  EXPECT_EQ(readAll(*openPlaceSource(folder.file(""), {}))[1].stamp, 13'250'000'000);
  for (const char* times : {"12.5\n", "12.5\n13.25\n14\n", "13.25\n12.5\n", "12.5\nlater\n"}) {
    urban_nav_input::testing::writeFile(folder.file("times.txt"), times);
    EXPECT_THROW(openPlaceSource(folder.file(""), {}), UserError) << times;
  }
}

TEST(PlaceFolder, OfAStereoFolderTheLeftImagesServe) {
  const TemporaryFolder folder;
  writeImage(folder.file("image_0/000000.png"), sceneImage(1));
  writeImage(folder.file("image_1/000000.png"), sceneImage(2));
  const auto source = openPlaceSource(folder.file(""), {});
  ASSERT_EQ(source->notes().size(), 1u);
  EXPECT_NE(source->notes()[0].find("image_0"), std::string::npos);
  EXPECT_EQ(cv::norm(readAll(*source).at(0).grey.at(0), sceneImage(1)), 0.0);
}

TEST(PlaceFolder, DamagedImagesAreReportedAndTheOthersRead) {
  const TemporaryFolder folder;
  urban_nav_input::testing::writeFile(folder.file("a.png"), "damaged");
  writeImage(folder.file("b.png"), sceneImage(2));
  const auto source = openPlaceSource(folder.file(""), {});
  const std::vector<PlaceImages> images = readAll(*source);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_TRUE(images[0].grey.at(0).empty());
  ASSERT_EQ(source->notes().size(), 1u);
  EXPECT_NE(source->notes()[0].find("a.png"), std::string::npos);
}

TEST(PlaceFolder, FoldersWithoutImagesAndMissingOnesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(openPlaceSource(folder.file(""), {}), UserError);
  EXPECT_THROW(openPlaceSource(folder.file("missing"), {}), UserError);
}

class PlaceBagTest : public ::testing::Test {
 protected:
  void write(const std::string& topic, double stamp, const cv::Mat& image) {
    sensor_msgs::CompressedImage message;
    message.header.stamp = ros::Time(stamp);
    message.format = "png";
    cv::imencode(".png", image, message.data);
    bag_.write(topic, message.header.stamp, message);
  }
  std::unique_ptr<PlaceSource> open(const std::vector<std::string>& topics = {}) {
    bag_.close();
    return openPlaceSource(path_, topics);
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_.file("drive.bag");
  rosbag::Bag bag_{path_, rosbag::bagmode::Write};
};

TEST_F(PlaceBagTest, GroupsTheImagesOfAPanoramaByStamp) {
  for (int k = 0; k < 3; ++k)
    for (int camera = 0; camera < 5; ++camera)
      if (k != 1 || camera != 3)
        write("/ladybug/camera" + std::to_string(camera) + "/image_raw/compressed", 10.0 + k,
              sceneImage(static_cast<unsigned>(10 * k + camera)));
  const auto source = open();
  const std::vector<PlaceImages> panoramas = readAll(*source);
  ASSERT_EQ(panoramas.size(), 3u);
  ASSERT_EQ(panoramas[1].grey.size(), 5u);
  EXPECT_EQ(panoramas[1].stamp, 11'000'000'000);
  EXPECT_TRUE(panoramas[1].grey[3].empty()) << "the image that is missing";
  EXPECT_EQ(cv::norm(panoramas[2].grey[4], sceneImage(24)), 0.0);
  ASSERT_FALSE(source->notes().empty());
  EXPECT_NE(source->notes()[0].find("5 cameras"), std::string::npos);
}

TEST_F(PlaceBagTest, WithoutPanoramasTheNamedCameraServes) {
  write("/front/image/compressed", 3.0, sceneImage(1));
  write("/front/image/compressed", 4.0, sceneImage(2));
  const auto source = open({"left:=/front/image/compressed"});
  const std::vector<PlaceImages> images = readAll(*source);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[1].stamp, 4'000'000'000);
}

TEST_F(PlaceBagTest, BagsWithoutImagesAndDamagedOnesAreRefused) {
  EXPECT_THROW(open(), DataError);
  urban_nav_input::testing::writeFile(folder_.file("damaged.bag"), "no bag");
  EXPECT_THROW(openPlaceSource(folder_.file("damaged.bag"), {}), UserError);
}

}  // namespace
}  // namespace urban_nav
