// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "base/console.hpp"
#include "commands/stages.hpp"
#include "simulate/simulate_command.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/pose.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;

SimulateJob shortJob(const TemporaryFolder& folder) {
  SimulateJob job;
  job.session.seed = 3;
  job.session.duration = 0.5;
  job.bag = folder.file("session.bag");
  return job;
}

int runSimulate(std::vector<std::string> words) {
  words.insert(words.begin(), {"urban_nav", "simulate"});
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({simulateCommand()}, addStageTables, static_cast<int>(argv.size()), argv.data());
}

template <typename Message>
std::vector<Message> messagesOfTopic(const std::string& path, const std::string& topic) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::vector<Message> messages;
  for (const rosbag::MessageInstance& instance : view) messages.push_back(*instance.instantiate<Message>());
  return messages;
}

std::map<std::string, urban_nav_core::Pose> statedPoses(const std::string& path) {
  std::map<std::string, urban_nav_core::Pose> poses;
  for (const auto& message : messagesOfTopic<tf2_msgs::TFMessage>(path, "/tf_static"))
    for (const auto& transform : message.transforms)
      poses[transform.child_frame_id] = *urban_nav_ros::toPose(transform.transform);
  return poses;
}

TEST(Simulate, LagsShiftStampsAndMisplacedFramesTurnInTfAlone) {
  const TemporaryFolder right, wrong;
  Console console;
  SimulateJob job = shortJob(right);
  job.session.sensors = {urban_nav_sim::Sensor::Lasers, urban_nav_sim::Sensor::Imu};
  simulate(job, console);
  job.bag = wrong.file("session.bag");
  job.lags = {"laser_right:0.03"};
  job.misplaced = {"laser_left:0,1,0"};
  simulate(job, console);
  for (const std::string side : {"left", "right"}) {
    const auto before = messagesOfTopic<sensor_msgs::LaserScan>(right.file("session.bag"), "/laser_" + side + "/scan");
    const auto after = messagesOfTopic<sensor_msgs::LaserScan>(job.bag, "/laser_" + side + "/scan");
    ASSERT_EQ(before.size(), after.size());
    ASSERT_FALSE(before.empty());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ((after[i].header.stamp - before[i].header.stamp).toNSec(), side == "right" ? 30'000'000 : 0);
      EXPECT_EQ(after[i].ranges, before[i].ranges) << "measurements are the same";
    }
  }
  EXPECT_EQ(readFile(right.file("session.truth/trajectory.tum")), readFile(wrong.file("session.truth/trajectory.tum")));
  const auto before = statedPoses(right.file("session.bag")), after = statedPoses(job.bag);
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [frame, T_base_frame] : before)
    EXPECT_NEAR(angleBetween(T_base_frame, after.at(frame)) * 180.0 / M_PI, frame == "laser_left" ? 1.0 : 0.0, 1e-5)
        << frame;
}

TEST(Simulate, AMisplacedHeadTurnsWithAllItsCameras) {
  const TemporaryFolder right, wrong;
  Console console;
  SimulateJob job = shortJob(right);
  job.session.sensors = {urban_nav_sim::Sensor::Imu};
  simulate(job, console);
  job.bag = wrong.file("session.bag");
  job.misplaced = {"ladybug:0,0,3"};
  simulate(job, console);
  const auto before = statedPoses(right.file("session.bag")), after = statedPoses(job.bag);
  ASSERT_EQ(before.size(), after.size());
  const urban_nav_core::Pose turn(urban_nav_core::expSo3({0.0, 0.0, 3.0 * M_PI / 180.0}), {0.0, 0.0, 0.0});
  for (const auto& [frame, T_base_frame] : before) {
    const bool is_camera = frame.find("ladybug") == 0;
    EXPECT_TRUE(isApprox(after.at(frame), is_camera ? turn * T_base_frame : T_base_frame, 1e-9))
        << frame << ": the head is above the origin of base_link";
  }
}

TEST(Simulate, RefusesErrorsOfUnknownDevicesAndFrames) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--lag", "stereo:0.1"},
                                             {"--lag", "laser_left"},
                                             {"--lag", "laser_left:fast"},
                                             {"--lag", "laser_left:60"},
                                             {"--misplace", "laser_left:1,2"},
                                             {"--misplace", "nose:1,2,3"},
                                             {"--misplace", "laser_left:1,2,x"}}) {
    const TemporaryFolder folder;
    std::vector<std::string> all = {"--duration", "0.2", "--sensors", "imu", "-o", folder.file("s.bag")};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(runSimulate(all), 2) << words[1];
    EXPECT_FALSE(fs::exists(folder.file("s.bag")));
  }
}

TEST(Simulate, WritesEveryTopicTheFolderAndTheTruth) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.folder = folder.file("kitti");
  Console console;
  const Simulated made = simulate(job, console);
  for (const char* topic : {"/stereo/left/image_raw", "/stereo/right/camera_info",
                            "/ladybug/camera4/image_raw/compressed", "/laser_left/scan", "/laser_right/scan",
                            "/imu/data", "/imu/mag", "/wheel_odom", "/ground_truth/pose", "/tf_static"})
    EXPECT_GT(made.counts.count(topic), 0U) << topic;
  EXPECT_EQ(made.counts.at("/stereo/left/image_raw"), 10);
  const rosbag::Bag bag(job.bag);
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery("/stereo/left/image_raw")).size(), 10U);

  EXPECT_EQ(urban_nav_core::readKitti(job.folder + "/poses.txt").size(), 10U);
  EXPECT_EQ(urban_nav_core::readTimes(job.folder + "/times.txt").size(), 10U);
  for (const char* name : {"trajectory.tum", "revisits.csv", "closures_true.csv", "cloud.ply"})
    EXPECT_TRUE(fs::exists(made.truth_folder + "/" + name)) << name;
  EXPECT_GE(urban_nav_core::readTum(made.truth_folder + "/trajectory.tum").size(), 100U);
}

TEST(Simulate, GivesTheSameBytesOnOneThreadAndOnTwo) {
  const TemporaryFolder first, second;
  Console console;
  const auto run = [&console](const TemporaryFolder& folder, int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    SimulateJob job = shortJob(folder);
    job.session.duration = 0.2;
    simulate(job, console);
    return readFile(job.bag);
  };
  EXPECT_EQ(run(first, 1), run(second, 2));
}

std::int64_t messagesIn(const std::string& path, const std::string& topic) {
  const rosbag::Bag bag(path);
  return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
}

TEST(Simulate, PartsTogetherHoldWhatOneBagHolds) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.sensors = {urban_nav_sim::Sensor::Imu, urban_nav_sim::Sensor::Wheels};
  Console console;
  const Simulated whole = simulate(job, console);
  EXPECT_EQ(whole.bags, std::vector<std::string>{job.bag});
  job.bag = folder.file("parts.bag");
  job.part = 0.2;
  const Simulated parts = simulate(job, console);
  ASSERT_EQ(parts.bags, (std::vector<std::string>{folder.file("parts_0.bag"), folder.file("parts_1.bag"),
                                                  folder.file("parts_2.bag")}));
  EXPECT_FALSE(fs::exists(job.bag));
  EXPECT_TRUE(fs::exists(folder.file("parts.truth/trajectory.tum")));
  for (const char* topic : {"/imu/data", "/wheel_odom", "/ground_truth/pose"}) {
    EXPECT_EQ(parts.counts.at(topic), whole.counts.at(topic)) << topic;
    std::int64_t found = 0;
    for (const std::string& part : parts.bags) found += messagesIn(part, topic);
    EXPECT_EQ(found, whole.counts.at(topic)) << topic;
  }
  for (const std::string& part : parts.bags) EXPECT_EQ(messagesIn(part, "/tf_static"), 1) << part;
  EXPECT_EQ(messagesIn(parts.bags[1], "/ground_truth/pose"), 40) << "0.2 s at 200 Hz";
}

TEST(Simulate, FaultsSpoilTheSensorNotTheTruth) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.sensors = {urban_nav_sim::Sensor::Imu, urban_nav_sim::Sensor::Wheels};
  job.session.faults = {urban_nav_sim::parseFault("unplug:wheels:0:9")};
  Console console;
  const Simulated made = simulate(job, console);
  EXPECT_EQ(made.counts.count("/wheel_odom"), 0U);
  EXPECT_EQ(made.counts.count("/stereo/left/image_raw"), 0U);
  EXPECT_GT(made.counts.at("/imu/data"), 40);
  EXPECT_GT(made.counts.at("/ground_truth/pose"), 90);
}

TEST(Simulate, AJumpOfStampsIsNoneOfTheRecorder) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.sensors = {urban_nav_sim::Sensor::Imu};
  job.session.faults = {urban_nav_sim::parseFault("jump:imu:0.2:0.1:5")};
  Console console;
  const Simulated made = simulate(job, console);
  const rosbag::Bag bag(job.bag);
  ros::Time received(0), stamped(0);
  int backward = 0, count = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/imu/data"))) {
    const ros::Time stamp = message.instantiate<sensor_msgs::Imu>()->header.stamp;
    EXPECT_GT(message.getTime(), received);
    backward += stamp < stamped ? 1 : 0;
    received = message.getTime();
    stamped = stamp;
    ++count;
  }
  EXPECT_EQ(backward, 1) << "in the order in which they came, the stamps go back once, when the jump ends";
  EXPECT_EQ(count, made.counts.at("/imu/data"));
  EXPECT_GT(count, 40);
}

TEST(Simulate, ViewsOfPixelsAndBeamsAreInTheTruthFolder) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.duration = 0.2;
  job.session.sensors = {urban_nav_sim::Sensor::Stereo, urban_nav_sim::Sensor::Lasers};
  job.session.views = job.session.sensors;
  job.session.defects.switchOff("all:all");
  Console console;
  const Simulated made = simulate(job, console);
  const rosbag::Bag bag(job.bag);
  int pairs = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/stereo/right/image_raw"))) {
    const auto stamp = message.instantiate<sensor_msgs::Image>()->header.stamp.toNSec();
    const std::string view = made.truth_folder + "/stereo_right_optical_frame/" + std::to_string(stamp);
    const cv::Mat depth = cv::imread(view + ".pfm", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_32F) << view;
    EXPECT_EQ(depth.size(), cv::Size(512, 384));
    EXPECT_GT(depth.at<float>(380, 256), 0.5F);  // the ground before the robot
    EXPECT_LT(depth.at<float>(380, 256), 10.0F);
    EXPECT_EQ(cv::imread(view + ".png", cv::IMREAD_UNCHANGED).type(), CV_8U);
    ++pairs;
  }
  EXPECT_EQ(pairs, 4);
  const auto beams = urban_nav_core::CsvTable::read(made.truth_folder + "/laser_left.csv");
  std::size_t row = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/laser_left/scan"))) {
    const auto scan = message.instantiate<sensor_msgs::LaserScan>();
    for (const float range : scan->ranges) {
      ASSERT_LT(row, beams.rows());
      if (range < 30.0F) {
        EXPECT_NEAR(static_cast<double>(range), beams.number(row, 2), 1e-6 * static_cast<double>(range));
      }
      ++row;
    }
  }
  EXPECT_EQ(row, beams.rows());
}

TEST(Simulate, SweepsAreWrittenOnRequestWithTheirTruth) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.world = "tunnel";
  job.session.duration = 0.4;
  job.session.sensors = {urban_nav_sim::Sensor::Lidar3d};
  job.session.lidar = urban_nav_sim::parseLidarModel("16", "--lidar");
  job.session.views = job.session.sensors;
  job.session.defects.switchOff("all:all");
  job.lags = {"lidar3d:0.02"};
  Console console;
  const Simulated result = simulate(job, console);
  EXPECT_EQ(statedPoses(job.bag).count("lidar3d"), 1U);
  const auto sweeps = messagesOfTopic<sensor_msgs::PointCloud2>(job.bag, "/points");
  ASSERT_EQ(sweeps.size(), 3U);
  for (const sensor_msgs::PointCloud2& sweep : sweeps) {
    EXPECT_EQ(sweep.header.frame_id, "lidar3d");
    const std::uint64_t true_stamp = sweep.header.stamp.toNSec() - 20'000'000;
    const std::string view = result.truth_folder + "/lidar3d/" + std::to_string(true_stamp);
    const cv::Mat range = cv::imread(view + ".pfm", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(range.size(), cv::Size(2000, 16)) << view;
    sensor_msgs::PointCloud2ConstIterator<float> x(sweep, "x"), time(sweep, "time");
    sensor_msgs::PointCloud2ConstIterator<std::uint16_t> ring(sweep, "ring");
    float last = -1.0F;
    for (; x != x.end(); ++x, ++time, ++ring) {
      ASSERT_GT(*time, last);
      last = *time;
      const int column = static_cast<int>(std::floor((*time + 0.1F) / 50e-6F - *ring / 16.0F + 0.5F));
      ASSERT_NEAR(range.at<float>(*ring, column), std::hypot(x[0], std::hypot(x[1], x[2])), 1e-3F);
    }
    EXPECT_LT(last, 0.0F);
  }
  EXPECT_TRUE(fs::exists(result.truth_folder + "/lidar3d_rings.csv"));
  EXPECT_FALSE(fs::exists(result.truth_folder + "/imu.csv"));
}

TEST(Simulate, WithoutThe3dLidarNothingOfItIsThere) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.sensors = {urban_nav_sim::Sensor::Imu, urban_nav_sim::Sensor::Wheels};
  Console console;
  const Simulated result = simulate(job, console);
  EXPECT_EQ(statedPoses(job.bag).count("lidar3d"), 0U);
  EXPECT_EQ(readFile(result.truth_folder + "/clocks.csv").find("lidar3d"), std::string::npos);
  EXPECT_FALSE(fs::exists(result.truth_folder + "/lidar3d_rings.csv"));
  EXPECT_TRUE(fs::exists(result.truth_folder + "/imu.csv"));
  EXPECT_TRUE(fs::exists(result.truth_folder + "/wheels.csv"));
}

TEST(Simulate, RawPairsHaveTheirRectification) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.duration = 0.1;
  job.session.sensors = {urban_nav_sim::Sensor::Stereo};
  job.session.defects.switchOn("stereo:lens");
  Console console;
  simulate(job, console);
  const rosbag::Bag bag(job.bag);
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/stereo/right/camera_info"))) {
    const auto info = message.instantiate<sensor_msgs::CameraInfo>();
    EXPECT_EQ(info->distortion_model, "plumb_bob");
    ASSERT_EQ(info->D.size(), 5U);
    EXPECT_LT(info->D[0], -0.1);
    EXPECT_NE(info->R[1], 0.0);
    EXPECT_NEAR(info->P[3], -389.956085 * 0.120005, 1e-9);
  }
}

TEST(Simulate, ABagGivesSpecificForce) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.duration = 0.2;
  job.session.sensors = {urban_nav_sim::Sensor::Stereo, urban_nav_sim::Sensor::Imu};
  Console console;
  simulate(job, console);
  for (const char* motion : {"none", "gyroscope"}) {
    urban_nav_input::SourceOptions options;
    options.motion_input = motion;
    const std::unique_ptr<urban_nav_input::Source> source = urban_nav_input::openSource({job.bag}, options);
    std::size_t inputs = 0;
    while (const auto pair = source->next()) inputs += pair->assembled.inputs.size();
    EXPECT_EQ(inputs > 0, std::string(motion) == "gyroscope");
    const std::vector<urban_nav_core::SpecificForce> forces = source->forces();
    ASSERT_GE(forces.size(), 18U) << motion;
    EXPECT_LT((forces[9].force - Eigen::Vector3d(0.0, 0.0, 9.81)).norm(), 2.0) << "up, in base_link";
    EXPECT_LT(source->info().last - source->info().first, 200'000'000) << "of the stereo stream alone";
  }
}

TEST(Simulate, DeviceClocksDeviateAsInTheTruth) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.sensors = {urban_nav_sim::Sensor::Imu};
  job.session.defects.switchOff("imu:jitter");
  Console console;
  const auto firstStamp = [&] {
    simulate(job, console);
    const rosbag::Bag bag(job.bag);
    rosbag::View view(bag, rosbag::TopicQuery("/imu/data"));
    return view.begin()->instantiate<sensor_msgs::Imu>()->header.stamp.toNSec();
  };
  const auto right = firstStamp();
  job.session.defects.switchOn("imu:clock");
  const auto off = 1e-9 * (static_cast<double>(firstStamp()) - static_cast<double>(right));
  const auto clocks = urban_nav_core::CsvTable::read(folder.file("session.truth/clocks.csv"));
  ASSERT_EQ(clocks.rows(), 6U);
  for (std::size_t row = 0; row < clocks.rows(); ++row) {
    const bool is_imu = clocks.text(row, clocks.column("sensor")) == "imu";
    if (is_imu) {
      EXPECT_NEAR(clocks.number(row, clocks.column("offset_s")), off, 1e-6);
    }
    EXPECT_EQ(clocks.number(row, clocks.column("skew")) != 0.0, is_imu);
  }
}

TEST(SimulateDeathTest, AnInterruptEndsItAndLeavesNoBag) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.sensors = {urban_nav_sim::Sensor::Imu};
  const auto runInterrupted = [&job] {
    sigset_t interrupts;
    sigemptyset(&interrupts);
    sigaddset(&interrupts, SIGINT);
    std::signal(SIGINT, SIG_DFL);
    pthread_sigmask(SIG_BLOCK, &interrupts, nullptr);
    std::raise(SIGINT);  // it waits, as one that comes while a frame is rendered
    Console console;
    try {
      simulate(job, console);
    } catch (const std::exception&) {
      pthread_sigmask(SIG_UNBLOCK, &interrupts, nullptr);
    }
  };
  EXPECT_EXIT(runInterrupted(), ::testing::KilledBySignal(SIGINT), "");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(job.bag).parent_path()))
    EXPECT_TRUE(entry.is_directory()) << entry.path();
}

TEST(Simulate, RestartsAnIncompleteFolder) {
  const TemporaryFolder folder;
  SimulateJob job = shortJob(folder);
  job.session.duration = 0.1;
  job.session.sensors = {urban_nav_sim::Sensor::Stereo};
  job.folder = folder.file("kitti");
  fs::create_directories(job.folder + "/image_0");
  urban_nav_input::testing::writeFile(job.folder + "/image_0/000007.png", "of a longer run");
  Console console;
  EXPECT_THROW(simulate(job, console), urban_nav_core::UserError) << "a folder of another program";
  EXPECT_FALSE(fs::exists(job.bag));
  urban_nav_input::testing::writeFile(job.folder + "/simulate.unfinished", "");
  simulate(job, console);
  EXPECT_FALSE(fs::exists(job.folder + "/image_0/000007.png"));
  EXPECT_FALSE(fs::exists(job.folder + "/simulate.unfinished"));
  EXPECT_EQ(urban_nav_core::readKitti(job.folder + "/poses.txt").size(), 2U);
  EXPECT_THROW(simulate(job, console), urban_nav_core::UserError) << "a folder that is complete";
}

TEST(Simulate, RefusesAnOutputThatIsNoBag) {
  const TemporaryFolder folder;
  EXPECT_EQ(runSimulate({"--duration", "0.2", "--sensors", "imu", "-o", folder.file("session.truth")}), 2);
  EXPECT_TRUE(fs::is_empty(fs::path(folder.file("x")).parent_path()));
}

TEST(Simulate, RefusesWhatThereIsNotAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("never.bag");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--world", "atlantis"},
                                                {"--route", "moonwalk"},
                                                {"--sensors", "stereo,sonar"},
                                                {"--sensors", "imu", "--lidar", "16"},
                                                {"--sensors", "lidar3d", "--lidar", "8"},
                                                {"--fault", "melt:stereo:0:1"},
                                                {"--fault", "stereo"},
                                                {"--duration", "0"},
                                                {"--with", "stereo:rust"},
                                                {"--without", "sonar:noise"},
                                                {"--views", "imu"},
                                                {"--views", "sonar"},
                                                {"--sensors", "imu", "--views", "stereo"},
                                                {"--with", "stereo:lens", "--folder", folder.file("kitti")},
                                                {"--split", "-1"},
                                                {"--sensors", "imu", "--folder", folder.file("kitti")}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", bag});
    EXPECT_EQ(runSimulate(all), 2) << words[0] << " " << words[1];
    EXPECT_TRUE(fs::is_empty(fs::path(bag).parent_path())) << words[0] << " " << words[1];
  }
}

}  // namespace
}  // namespace urban_nav
