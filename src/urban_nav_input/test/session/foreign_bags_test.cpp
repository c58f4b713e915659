// SPDX-License-Identifier: BSD-3-Clause
// Bags as converters, mergers and drivers without clocks leave them.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <filesystem>
#include <functional>
#include <map>

#include "urban_nav_input/examination/input_info.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/sessions.hpp"

#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::StampNs;

constexpr int kPairs = 12;
constexpr double kBegin = 1.5e9, kPeriod = 0.05;  // s

sensor_msgs::Image image(double stamp, std::uint16_t grey) {
  sensor_msgs::Image message;
  message.header.stamp = ros::Time(stamp);
  message.encoding = "mono16";
  message.width = 32;
  message.height = 24;
  message.step = 64;
  message.data.assign(message.step * message.height, 0);
  for (std::size_t i = 0; i < message.data.size(); i += 2) {
    message.data[i] = static_cast<std::uint8_t>(grey & 255U);
    message.data[i + 1] = static_cast<std::uint8_t>(grey >> 8U);
  }
  return message;
}

sensor_msgs::CameraInfo cameraInfo(double stamp, double baseline) {
  sensor_msgs::CameraInfo message;
  message.header.stamp = ros::Time(stamp);
  message.width = 32;
  message.height = 24;
  message.P = {30, 0, 15.5, -30 * baseline, 0, 30, 11.5, 0, 0, 0, 1, 0};  // alone, as for rectified images
  return message;
}

struct Recipe {
  double right_late = 0.0;  ///< s
  bool stamped = true;
  std::string left = "/stereo/left", right = "/stereo/right";
  std::uint16_t left_grey = 900, right_grey = 1100;
  /// Time of receipt, s, of message `i` of topic number `topic` (0...3), stamped `stamp`.
  std::function<double(int topic, int i, double stamp)> receipt = [](int, int, double stamp) { return stamp + 0.01; };
};

void writeBag(const std::string& path, const Recipe& recipe, double begin = kBegin,
              rosbag::bagmode::BagMode mode = rosbag::bagmode::Write) {
  rosbag::Bag bag(path, mode);
  for (int i = 0; i < kPairs; ++i) {
    const double stamp = begin + kPeriod * i, right = stamp + recipe.right_late;
    const auto header = [&](double time) { return recipe.stamped ? time : 0.0; };
    const auto at = [&](int topic, double time) { return ros::Time(recipe.receipt(topic, i, time)); };
    bag.write(recipe.left + "/image_raw", at(0, stamp), image(header(stamp), recipe.left_grey));
    bag.write(recipe.right + "/image_raw", at(1, right), image(header(right), recipe.right_grey));
    bag.write(recipe.left + "/camera_info", at(2, stamp), cameraInfo(header(stamp), 0.0));
    bag.write(recipe.right + "/camera_info", at(3, right), cameraInfo(header(right), 0.2));
  }
}

struct Reading {
  std::vector<StampNs> stamps;
  int whole = 0;  ///< pairs with both images
  double left_grey = 0.0, right_grey = 0.0;
  std::vector<std::string> faults, options;
  std::string notes;
};

Reading readBag(const std::string& path, const SourceOptions& options = {}, const ReceiptRange& part = {}) {
  const std::unique_ptr<Source> source = openSource({path}, options, nullptr, part);
  Reading reading;
  for (const std::string& note : source->info().notes) reading.notes += note + "\n";
  while (const auto item = source->next()) {
    const auto& pair = item->assembled.pair;
    reading.stamps.push_back(pair.stamp);
    if (pair.left.empty() || pair.right.empty()) continue;
    ++reading.whole;
    reading.left_grey = pair.left.data[0];
    reading.right_grey = pair.right.data[0];
  }
  reading.faults = source->closingFaults();
  for (const Finding& finding : source->sensorFindings()) {
    reading.faults.push_back(finding.text);
    reading.options.insert(reading.options.end(), finding.options.begin(), finding.options.end());
  }
  return reading;
}

TEST(ForeignBags, WrittenTopicAfterTopicComeInTheOrderOfStamps) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.receipt = [](int topic, int i, double) { return 1.6e9 + 0.001 * (kPairs * topic + i); };
  writeBag(folder.file("a.bag"), recipe);
  const Reading reading = readBag(folder.file("a.bag"));
  EXPECT_EQ(reading.whole, kPairs);
  EXPECT_TRUE(std::is_sorted(reading.stamps.begin(), reading.stamps.end()));
  EXPECT_TRUE(reading.faults.empty());
  EXPECT_NE(reading.notes.find("sorted by stamp"), std::string::npos) << reading.notes;
}

TEST(ForeignBags, OverASlowLinkLoseNothing) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.receipt = [](int topic, int i, double stamp) { return stamp + (topic == 1 ? 1.0 + 0.2 * (i % 3) : 0.01); };
  writeBag(folder.file("a.bag"), recipe);
  EXPECT_EQ(readBag(folder.file("a.bag")).whole, kPairs);
}

TEST(ForeignBags, WithoutStampsHaveTheTimesOfReceipt) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.stamped = false;
  recipe.receipt = [](int topic, int, double stamp) { return stamp + 0.01 * topic; };
  writeBag(folder.file("a.bag"), recipe);
  const Reading reading = readBag(folder.file("a.bag"));
  EXPECT_EQ(reading.whole, kPairs);
  EXPECT_NEAR(1e-9 * static_cast<double>(reading.stamps.front()), kBegin, 1e-6);
  EXPECT_NE(reading.notes.find("received"), std::string::npos) << reading.notes;
}

TEST(ForeignBags, AConstantDelayOfOneCameraIsNamedAndCanBeTakenAway) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.right_late = 0.008;
  writeBag(folder.file("a.bag"), recipe);
  const Reading reading = readBag(folder.file("a.bag"));
  EXPECT_EQ(reading.whole, 0);
  ASSERT_FALSE(reading.faults.empty());
  EXPECT_NE(reading.faults[0].find("8 ms later"), std::string::npos) << reading.faults[0];
  EXPECT_EQ(reading.options, (std::vector<std::string>{"--set", "input.right_delay=8"}));
  SourceOptions options;
  options.pairing.right_delay = 8'000'000;
  EXPECT_EQ(readBag(folder.file("a.bag"), options).whole, kPairs);
}

TEST(ForeignBags, PairsAreOfOneHead) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.left = "/body/left/cam/left";
  recipe.right = "/body/left/cam/right";
  writeBag(folder.file("one.bag"), recipe);
  {
    rosbag::Bag bag(folder.file("one.bag"), rosbag::bagmode::Append);
    for (int i = 0; i < kPairs; ++i) {
      const double stamp = kBegin + kPeriod * i;
      for (const char* side : {"left", "right"}) {
        const std::string camera = std::string("/body/right/cam/") + side;
        bag.write(camera + "/image_raw", ros::Time(stamp), image(stamp, 40));
        bag.write(camera + "/camera_info", ros::Time(stamp), cameraInfo(stamp, side[0] == 'r' ? 0.2 : 0.0));
      }
    }
  }
  const Reading reading = readBag(folder.file("one.bag"));
  EXPECT_EQ(reading.whole, kPairs);
  EXPECT_NE(reading.notes.find("left: /body/left/cam/left/image_raw"), std::string::npos) << reading.notes;
  EXPECT_NE(reading.notes.find("right: /body/left/cam/right/image_raw"), std::string::npos) << reading.notes;
}

TEST(ForeignBags, DeepImagesHaveOneScaleForBothCameras) {
  const TemporaryFolder folder;
  writeBag(folder.file("a.bag"), {});  // 900 and 1100: a narrow range of twelve bits, stretched
  const Reading narrow = readBag(folder.file("a.bag"));
  EXPECT_EQ(narrow.left_grey, 0);
  EXPECT_GE(narrow.right_grey, 250);
  Recipe recipe;
  recipe.left_grey = 900;
  recipe.right_grey = 3900;
  writeBag(folder.file("b.bag"), recipe);
  const Reading wide = readBag(folder.file("b.bag"));
  EXPECT_EQ(wide.left_grey, 900 >> 4);
  EXPECT_EQ(wide.right_grey, 3900 >> 4);
}

TEST(ForeignBags, OfTwoDaysAreTwoSessionsWheneverTheyWereWritten) {
  const TemporaryFolder folder;
  for (const int day : {0, 1}) {
    Recipe recipe;
    recipe.receipt = [day](int, int i, double) { return 1.7e9 + day + 0.05 * i; };
    writeBag(folder.file("day" + std::to_string(day) + ".bag"), recipe, kBegin + 86400.0 * day);
  }
  EXPECT_EQ(findSessions({folder.file("day0.bag"), folder.file("day1.bag")}).size(), 2U);
}

TEST(ForeignBags, RunsWhoseClockRestartsAreTwoSessions) {
  const TemporaryFolder folder;
  for (const int day : {0, 1}) {
    Recipe recipe;
    recipe.receipt = [day](int, int, double stamp) { return stamp + 86400.0 * day; };
    writeBag(folder.file("run" + std::to_string(day) + ".bag"), recipe);
  }
  EXPECT_EQ(findSessions({folder.file("run0.bag"), folder.file("run1.bag")}).size(), 2U);
}

TEST(ForeignBags, ABagAndItsCopyCountOnce) {
  const TemporaryFolder folder;
  writeBag(folder.file("a.bag"), {});
  std::filesystem::copy_file(folder.file("a.bag"), folder.file("copy.bag"));
  for (const char* second : {"copy.bag", "a.bag"}) {
    const std::vector<InputSession> sessions = findSessions({folder.file("a.bag"), folder.file(second)});
    ASSERT_EQ(sessions.size(), 1U);
    EXPECT_EQ(sessions[0].paths, std::vector<std::string>{folder.file("a.bag")});
    EXPECT_NE(sessions[0].note.find("given twice"), std::string::npos) << sessions[0].note;
  }
  Recipe other;
  other.left_grey = 901;  // another run of the same simulation
  writeBag(folder.file("other.bag"), other);
  EXPECT_EQ(findSessions({folder.file("a.bag"), folder.file("other.bag")}).size(), 2U);
}

TEST(ForeignBags, StampsThatDoNotChangeAreReplacedByTimesOfReceipt) {
  const TemporaryFolder folder;
  {
    rosbag::Bag bag(folder.file("a.bag"), rosbag::bagmode::Write);
    for (int i = 0; i < kPairs; ++i) {
      const ros::Time at(kBegin + 5.0 + kPeriod * i);
      bag.write("/stereo/left/image_raw", at, image(kBegin, 900));
      bag.write("/stereo/right/image_raw", at + ros::Duration(0.004), image(kBegin, 3900));
      bag.write("/stereo/left/camera_info", at, cameraInfo(kBegin, 0.0));
      bag.write("/stereo/right/camera_info", at, cameraInfo(kBegin, 0.2));
    }
  }
  const Reading reading = readBag(folder.file("a.bag"));
  EXPECT_EQ(reading.whole, kPairs);
  EXPECT_NEAR(1e-9 * static_cast<double>(reading.stamps.front()), kBegin + 5.0, 0.01);
  EXPECT_NE(reading.notes.find("equal: the times at which messages were received"), std::string::npos) << reading.notes;
  const InputInfo info = lookInto(folder.file("a.bag"));
  ASSERT_EQ(info.streams.size(), 4U);
  EXPECT_NEAR(info.streams[1].rate_hz, 1.0 / kPeriod, 0.1);
}

TEST(ForeignBags, InfoCountsByTheStampsOfHeaders) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.receipt = [](int topic, int i, double) { return 1.7e9 + topic + 0.001 * i; };
  writeBag(folder.file("a.bag"), recipe);
  const InputInfo info = lookInto(folder.file("a.bag"));
  ASSERT_EQ(info.streams.size(), 4U);
  for (const StreamInfo& stream : info.streams) {
    EXPECT_NEAR(stream.rate_hz, 1.0 / kPeriod, 0.1) << stream.name;
    EXPECT_NEAR(1e-9 * static_cast<double>(stream.first), kBegin, 1e-6) << stream.name;
  }
  ASSERT_EQ(info.notes.size(), 4U);
  EXPECT_NE(info.notes.front().find("received from 170000000"), std::string::npos) << info.notes.front();
}

TEST(ForeignBags, SimultaneousImagesOfTheSameTopicsAreTwoSessions) {
  const TemporaryFolder folder;
  const double whole = kPeriod * kPairs;
  for (const char* robot : {"a", "b"})
    for (const int part : {0, 1})  // split, and begun a little apart
      writeBag(folder.file(robot + std::to_string(part) + ".bag"), {},
               kBegin + (*robot == 'b' ? 0.2 : 0.0) * whole + part * whole);
  const std::vector<InputSession> sessions =
      findSessions({folder.file("a0.bag"), folder.file("b0.bag"), folder.file("b1.bag"), folder.file("a1.bag")});
  ASSERT_EQ(sessions.size(), 2U);
  EXPECT_EQ(sessions[0].paths, (std::vector<std::string>{folder.file("a0.bag"), folder.file("a1.bag")}));
  EXPECT_EQ(sessions[1].paths, (std::vector<std::string>{folder.file("b0.bag"), folder.file("b1.bag")}));
  EXPECT_TRUE(sessions[0].note.empty());
  EXPECT_NE(sessions[1].note.find("at the same time as " + folder.file("a0.bag")), std::string::npos)
      << sessions[1].note;
}

TEST(ForeignBags, SimultaneousBagsOfOtherTopicsAreOneSession) {
  const TemporaryFolder folder;
  writeBag(folder.file("stereo.bag"), {});
  {
    rosbag::Bag bag(folder.file("other.bag"), rosbag::bagmode::Write);
    for (int i = 0; i < kPairs; ++i)
      bag.write("/tilt/camera_info", ros::Time(kBegin + kPeriod * i), cameraInfo(kBegin + kPeriod * i, 0.0));
  }
  const std::vector<InputSession> sessions = findSessions({folder.file("stereo.bag"), folder.file("other.bag")});
  ASSERT_EQ(sessions.size(), 1U);
  EXPECT_EQ(sessions[0].paths.size(), 2U);
  EXPECT_TRUE(sessions[0].note.empty());
}

TEST(ForeignBags, TheUserStatesWhichRecordingsFormASession) {
  const TemporaryFolder folder;
  writeBag(folder.file("a.bag"), {});
  writeBag(folder.file("b.bag"), {}, kBegin + 1.0);
  const std::vector<std::string> paths = {folder.file("a.bag"), folder.file("b.bag")};
  EXPECT_EQ(findSessions(paths).size(), 1U);
  EXPECT_EQ(findSessions(paths, {}, SessionRule::Apart).size(), 2U);
  writeBag(folder.file("b.bag"), {}, kBegin + 3600.0);
  EXPECT_EQ(findSessions(paths).size(), 2U);
  EXPECT_EQ(findSessions(paths, {}, SessionRule::Together).size(), 1U);
}

/// Received from kBegin on without a break; after `kPairs` pairs the clock is set back by `back` (s).
void writeBagWithStep(const std::string& path, double back) {
  Recipe recipe;
  writeBag(path, recipe);
  recipe.receipt = [back](int, int, double stamp) { return stamp + back + 0.01; };
  writeBag(path, recipe, kBegin + kPeriod * kPairs - back, rosbag::bagmode::Append);
}

TEST(ForeignBags, AClockThatIsSetBackBeginsASession) {
  const TemporaryFolder folder;
  for (const double back : {0.07, 0.25, 1.5, 3600.0}) {  // from one interval of the images on
    const std::string path = folder.file("step.bag");
    writeBagWithStep(path, back);
    const std::vector<InputSession> sessions = findSessions({path});
    ASSERT_EQ(sessions.size(), 2U);
    EXPECT_TRUE(sessions[0].note.empty());
    EXPECT_NE(sessions[1].note.find("stamps step back"), std::string::npos);
    EXPECT_EQ(sessionNames(sessions), (std::vector<std::string>{"step", "step_2"}));
    for (const InputSession& session : sessions) {
      const Reading reading = readBag(path, {}, session.part);
      EXPECT_EQ(reading.whole, kPairs);
      EXPECT_TRUE(reading.faults.empty());
      EXPECT_EQ(reading.notes.find("step back"), std::string::npos);
    }
  }
}

TEST(ForeignBags, AStepBetweenTheBagsOfARecordingBeginsASession) {
  const TemporaryFolder folder;
  writeBagWithStep(folder.file("a.bag"), 20.0);
  Recipe recipe;  // the recording goes on in another bag
  recipe.receipt = [](int, int, double stamp) { return stamp + 20.01; };
  writeBag(folder.file("b.bag"), recipe, kBegin + 2.0 * kPeriod * kPairs - 20.0);
  const std::vector<InputSession> sessions = findSessions({folder.file("a.bag"), folder.file("b.bag")});
  ASSERT_EQ(sessions.size(), 2U);
  EXPECT_EQ(sessions[0].paths, std::vector<std::string>{folder.file("a.bag")});
  ASSERT_EQ(sessions[1].paths.size(), 2U);
  const std::unique_ptr<Source> source = openSource(sessions[1].paths, {}, nullptr, sessions[1].part);
  int pairs = 0;
  while (source->next()) ++pairs;
  EXPECT_EQ(pairs, 2 * kPairs);
}

TEST(ForeignBags, TopicsThatAreNotUsedAreNamedAndCounted) {
  const TemporaryFolder folder;
  writeBag(folder.file("a.bag"), {});
  EXPECT_EQ(readBag(folder.file("a.bag")).notes.find("not used"), std::string::npos);
  {
    rosbag::Bag bag(folder.file("a.bag"), rosbag::bagmode::Append);
    for (int i = 0; i < 3; ++i) bag.write("/depth", ros::Time(kBegin + i), cameraInfo(kBegin + i, 0.0));
    bag.write("/tf", ros::Time(kBegin), cameraInfo(kBegin, 0.0));
  }
  const std::string notes = readBag(folder.file("a.bag")).notes;
  EXPECT_NE(notes.find("not used: /depth (sensor_msgs/CameraInfo, 3 messages)\n"), std::string::npos) << notes;
}

TEST(ForeignBags, OneImageOutOfOrderIsNoClockStep) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.receipt = [](int, int i, double stamp) { return stamp + 0.01 + (i == kPairs / 2 ? 0.06 : 0.0); };
  writeBag(folder.file("a.bag"), recipe);
  EXPECT_EQ(findSessions({folder.file("a.bag")}).size(), 1U);
}

TEST(ForeignBags, ASlowLinkIsNoClockStep) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.receipt = [](int, int i, double stamp) { return stamp + 0.01 + (i > kPairs / 2 ? 5.0 : 0.0); };
  writeBag(folder.file("a.bag"), recipe);
  EXPECT_EQ(findSessions({folder.file("a.bag")}).size(), 1U);
}

}  // namespace
}  // namespace urban_nav_input
