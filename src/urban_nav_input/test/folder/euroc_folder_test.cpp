// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/euroc_layout.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using testing::writeFile;
using urban_nav_core::UserError;

std::string sensorYaml(double y_of_camera) {
  return "%YAML:1.0\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0.0, 0.0, 1.0, 0.1,\n   -1.0, 0.0, "
         "0.0, " +
         std::to_string(y_of_camera) +
         ",\n   0.0, -1.0, 0.0, 0.0,\n   0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nresolution: [64, 48]\ncamera_model: "
         "pinhole\nintrinsics: [60.0, 60.0, 31.5, 23.5]\n"
         "distortion_model: radial-tangential\ndistortion_coefficients: [-0.1, 0.01, 0.0, 0.0]\n";
}

/// Two frames, cameras 0.1 m ahead of the body and 0.2 m apart across it.
void makeEuroc(const std::string& path) {
  const cv::Mat picture(48, 64, CV_8UC1, cv::Scalar(90));
  for (const char* camera : {"cam0", "cam1"}) {
    const std::string folder = path + "/mav0/" + camera;
    writeFile(folder + "/sensor.yaml", sensorYaml(std::string(camera) == "cam0" ? 0.1 : -0.1));
    std::string csv = "#timestamp [ns],filename\n";
    std::filesystem::create_directories(folder + "/data");
    for (const char* stamp : {"1403715273262142976", "1403715273312143104"}) {
      csv += std::string(stamp) + "," + stamp + ".png\n";
      cv::imwrite(folder + "/data/" + stamp + ".png", picture);
    }
    writeFile(folder + "/data.csv", csv);
  }
}

TEST(EurocFolder, IsRectifiedOnReading) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  const auto source = openEurocFolder(folder.file("in"), {});
  EXPECT_EQ(source->info().frames, 2);
  EXPECT_NEAR(source->info().camera.baseline, 0.2, 1e-9);
  const std::optional<SourceItem> input = source->next();
  ASSERT_TRUE(input);
  EXPECT_TRUE(input->faults.empty());
  EXPECT_EQ(input->assembled.pair.stamp, 1403715273262142976);
  EXPECT_EQ(input->assembled.pair.left.width, source->info().camera.left.width);
  EXPECT_EQ(input->assembled.pair.left.at(32, 24), 90);
  EXPECT_EQ(input->assembled.pair.right.at(32, 24), 90);
}

TEST(EurocFolder, NamesWhatIsNotUsed) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  std::filesystem::create_directories(folder.file("in") + "/mav0/leica0");
  const auto source = openEurocFolder(folder.file("in"), {});
  EXPECT_EQ(source->info().notes.back(), "not used: leica0/");
}

TEST(EurocFolder, NamesAnImageThatIsNotThere) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  std::filesystem::remove(folder.file("in/mav0/cam1/data/1403715273312143104.png"));
  const auto source = openEurocFolder(folder.file("in"), {});
  source->next();
  const std::optional<SourceItem> second = source->next();
  ASSERT_EQ(second->faults.size(), 1U);
  EXPECT_NE(second->faults[0].find("cam1/data/1403715273312143104.png"), std::string::npos);
  EXPECT_TRUE(second->assembled.pair.right.empty());
  EXPECT_FALSE(source->next());
}

TEST(EurocFolder, GivesSpecificForce) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  EXPECT_TRUE(openEurocFolder(folder.file("in"), {})->forces().empty());
  const std::string imu = folder.file("in/mav0/imu0/data.csv");
  writeFile(imu, "#timestamp,wx,wy,wz,ax,ay,az\n1403715273262142976,0,0,0,0.1,-0.2,9.8\n");
  const auto forces = openEurocFolder(folder.file("in"), {})->forces();
  ASSERT_EQ(forces.size(), 1U);
  EXPECT_EQ(forces[0].stamp, 1403715273262142976);
  const urban_nav_core::Pose T_base_body = readEurocRig(folder.file("in/mav0")).T_base_body;
  EXPECT_LT((forces[0].force - T_base_body.R() * urban_nav_core::Vector3d(0.1, -0.2, 9.8)).norm(), 1e-12);
  writeFile(imu, "#timestamp,wx,wy,wz,ax,ay,az\n1403715273262142976,0,0,0,rubbish,0.1,-0.2\n");
  const auto source = openEurocFolder(folder.file("in"), {});
  EXPECT_TRUE(source->forces().empty());
  std::string notes;
  for (const std::string& note : source->info().notes) notes += note + "\n";
  EXPECT_NE(notes.find("imu0/data.csv:2"), std::string::npos) << notes;
}

TEST(EurocFolder, ListsAPairWithOneImage) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  writeFile(folder.file("in/mav0/cam1/data.csv"),
            "#timestamp [ns],filename\n1403715273312143104,1403715273312143104.png\n");
  const std::vector<EurocPair> pairs = readEurocPairs(folder.file("in/mav0"));
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_TRUE(pairs[0].right.empty());
  EXPECT_FALSE(pairs[1].right.empty());
}

TEST(EurocFolder, PutsTheTruthOntoBaseLink) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  writeFile(
      folder.file("in/mav0/state_groundtruth_estimate0/data.csv"),
      "#timestamp,px,py,pz,qw,qx,qy,qz\n1403715273262142976,1,2,3,1,0,0,0\n1403715273312143104,1,2,3.5,1,0,0,0\n");
  const EurocRig rig = readEurocRig(folder.file("in/mav0"));
  const auto truth = readEurocTruth(folder.file("in/mav0"), rig.T_base_body);
  ASSERT_TRUE(truth);
  EXPECT_LT((truth->front().pose.t() - urban_nav_core::Vector3d(1.1, 2.1, 3.0)).norm(), 1e-9)
      << "where the left camera is";
  EXPECT_LT((truth->front().pose * urban_nav_core::Vector3d(1, 0, 0) - urban_nav_core::Vector3d(2.1, 2.1, 3.0)).norm(),
            1e-9)
      << "x is ahead";
}

TEST(EurocFolder, NamesFileAndLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  makeEuroc(folder.file("in"));
  const auto failure = [&] {
    try {
      openEurocFolder(folder.file("in"), {});
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  writeFile(folder.file("in/mav0/cam0/data.csv"), "#timestamp [ns],filename\n1403715273262142976,a.png\nlater,b.png\n");
  EXPECT_NE(failure().find("cam0/data.csv:3"), std::string::npos) << failure();
  writeFile(folder.file("in/mav0/cam0/data.csv"), "#timestamp [ns],filename\n1403715273262142976,../../secret.png\n");
  EXPECT_NE(failure().find("cam0/data.csv:2"), std::string::npos) << failure();
  writeFile(folder.file("in/mav0/cam0/sensor.yaml"), "rate_hz: 20\n");
  EXPECT_NE(failure().find("cam0/sensor.yaml"), std::string::npos) << failure();
}

}  // namespace
}  // namespace urban_nav_input
