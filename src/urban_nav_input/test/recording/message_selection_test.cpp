// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/message_selection.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;

std_msgs::String makeText(const std::string& text) {
  std_msgs::String message;
  message.data = text;
  return message;
}

std::string readAll(MessageSelection selection) {
  std::string all;
  while (const std::optional<RecordedMessage> message = selection.next()) all += message->as<std_msgs::String>()->data;
  return all;
}

TEST(MessageSelection, IsInTheOrderOfReceiptThenOfTopicsThenOfFiles) {
  const TemporaryFolder folder;
  {
    rosbag::Bag a(folder.file("a.bag"), rosbag::bagmode::Write), b(folder.file("b.bag"), rosbag::bagmode::Write);
    a.write("/z", ros::Time(1.0), makeText("3"));
    a.write("/x", ros::Time(1.0), makeText("1"));
    a.write("/x", ros::Time(1.0), makeText("2"));
    b.write("/z", ros::Time(1.0), makeText("4"));
    b.write("/x", ros::Time(0.5), makeText("0"));
    b.write("/x", ros::Time(2.0), makeText("5"));
  }
  Recording recording({folder.file("a.bag"), folder.file("b.bag")});
  EXPECT_EQ(readAll(recording.select(std::nullopt)), "012345");
  EXPECT_EQ(readAll(recording.select(std::vector<std::string>{"/x"})), "0125");
  EXPECT_EQ(readAll(recording.select(std::nullopt, {1'000'000'000, 2'000'000'000})), "1234");
  EXPECT_EQ(recording.select(std::nullopt).first(), 500'000'000);
  EXPECT_EQ(recording.select(std::nullopt).last(), 2'000'000'000);
  EXPECT_EQ(recording.count("/x"), 4U);
  EXPECT_EQ(recording.select(std::vector<std::string>{"/none"}).size(), 0U);
}

}  // namespace
}  // namespace urban_nav_input
