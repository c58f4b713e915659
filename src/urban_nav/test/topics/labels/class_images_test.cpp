// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/class_images.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <string>

#include "scene_labeler/classes.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {
namespace {

using scene_labeler::SceneClass;

constexpr urban_nav_core::StampNs kImageTime = 1'600'000'000'123'456'789;

sensor_msgs::Image classImage(const std::string& frame, urban_nav_core::StampNs stamp, std::uint8_t id,
                              const std::string& encoding = sensor_msgs::image_encodings::MONO8) {
  sensor_msgs::Image image;
  image.header.frame_id = frame;
  image.header.stamp = urban_nav_ros::toRosTime(stamp);
  image.encoding = encoding;
  image.width = image.step = 4;
  image.height = 3;
  image.data.assign(12, id);
  return image;
}

/// A bag with one class image, received long after the image that it is of.
std::string bagWith(const std::string& name, const sensor_msgs::Image& image) {
  const std::string path = ::testing::TempDir() + name;
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.write("/classes", ros::Time(1'700'000'000, 0), image);
  return path;
}

TEST(ClassImages, AreFoundByFrameAndStampInAnyOfTheBags) {
  const std::string first = bagWith("class_images_1.bag", classImage("camera1", kImageTime, 1));
  const std::string second = bagWith("class_images_2.bag", classImage("camera4", kImageTime, 3));
  const ClassImages images({first, second}, "/classes", "");
  EXPECT_EQ(images.size(), 2U);
  const cv::Mat right = images.at("camera1", kImageTime), left = images.at("camera4", kImageTime);
  ASSERT_EQ(right.size(), cv::Size(4, 3));
  ASSERT_EQ(left.size(), cv::Size(4, 3));
  EXPECT_EQ(right.at<std::uint8_t>(2, 3), 1);
  EXPECT_EQ(left.at<std::uint8_t>(2, 3), 3);
  EXPECT_TRUE(images.at("camera1", kImageTime + 1).empty());
  EXPECT_TRUE(images.at("camera0", kImageTime).empty());
  EXPECT_EQ(ClassImages({first}, "/other", "").size(), 0U);
  EXPECT_EQ(ClassImages({first}, "", "").size(), 0U);
}

TEST(ClassImages, HaveTheClassesOfTheFile) {
  const std::string file = ::testing::TempDir() + "classes.csv";
  urban_nav_core::writeAtomically(file, "id,class\n7,vehicle\n9,ignore\n");
  const std::string vehicle = bagWith("class_images_7.bag", classImage("camera1", kImageTime, 7));
  const std::string unlisted = bagWith("class_images_8.bag", classImage("camera1", kImageTime, 8));
  EXPECT_EQ(ClassImages({vehicle}, "/classes", file).at("camera1", kImageTime).at<std::uint8_t>(0, 0),
            toIndex(SceneClass::Vehicle));
  EXPECT_EQ(ClassImages({unlisted}, "/classes", file).at("camera1", kImageTime).at<std::uint8_t>(0, 0),
            static_cast<std::uint8_t>(SceneClass::None));
}

TEST(ClassImages, OfOtherEncodingsAreNone) {
  const std::string bag = bagWith("class_images_mono16.bag", classImage("camera1", kImageTime, 1, "mono16"));
  EXPECT_TRUE(ClassImages({bag}, "/classes", "").at("camera1", kImageTime).empty());
}

TEST(ClassImages, ABagThatWasCutOffIsNamed) {
  const std::string path = ::testing::TempDir() + "class_images_cut.bag";
  urban_nav_core::writeAtomically(path, "#ROSBAG V2.0\n");
  EXPECT_THROW(ClassImages({path}, "/classes", ""), urban_nav_core::DataError);
}

}  // namespace
}  // namespace urban_nav
