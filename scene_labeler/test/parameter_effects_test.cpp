// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <cmath>

#include "live/live_labels.hpp"
#include "scene_labeler/class_map.hpp"
#include "support/yard.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::PlanarScan;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr int kFrames = 200;  // of 50 ms and 10 cm
constexpr StampNs kFrameNs = 50'000'000;
constexpr int kImageEvery = 10, kClassesLate = 20;  // frames
constexpr int kColumns = 96, kRows = 128;
constexpr int kClassId = 6;  // foliage, without a file of classes

/// Ground and a wall 4 m to the left.
PlanarScan scanStreet(StampNs stamp) {
  PlanarScan scan;
  scan.stamp = stamp;
  scan.angle_first = -M_PI / 3.0;
  scan.angle_step = M_PI / 180.0;
  scan.range_max = 30.0;
  for (int i = 0; i <= 100; ++i) {
    const double angle = scan.angle_first + scan.angle_step * i;
    const double ground = angle < 0.0 ? 1.0 / std::sin(-angle) : scan.range_max;
    scan.ranges.push_back(static_cast<float>(std::min(3.8 / std::cos(angle), ground)));
    scan.intensities.push_back(60.0F);
  }
  return scan;
}

cv::Mat takeImage() {
  cv::Mat image(kRows, kColumns, CV_8UC3);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      image.at<cv::Vec3b>(row, column) =
          cv::Vec3b(90, static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(column));
  return image;
}

/// Labels a drive past a wall like the nodelet. Another source sends the classes of each image a second later.
std::string labelDrive(const Parameters& parameters) {
  std::string bytes;
  const auto take = [&bytes](const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
    for (std::size_t i = 0; i < returns.size(); ++i)
      bytes += std::to_string(returns[i].scan) + " " + std::to_string(static_cast<int>(labels.labels[i])) + " " +
               std::to_string(labels.probability(i)) + " " + std::to_string(labels.unsure[i]) + "\n";
  };
  const ClassMap map = parameters.class_file.empty() ? ClassMap() : ClassMap(parameters.class_file);
  LiveLabels drive(parameters, readModel(parameters.model),
                   {take, [](std::size_t, const DriveFrame&, const cv::Mat&) {}});
  Eigen::Matrix3d R_laser, R_camera;
  R_laser << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  R_camera << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // x along the street, z to the left
  drive.setLaser(0, Pose(R_laser, Vector3d(0.0, 0.2, 1.0)));
  SideRig::Camera camera;
  camera.raw.pinhole = {60.0, 60.0, 48.0, 64.0, kColumns, kRows};
  camera.T_base_camera = Pose(R_camera, Vector3d(0.0, 0.0, 1.2));
  drive.setCamera(0, camera);
  for (int i = 0; i < kFrames; ++i) {
    const StampNs stamp = i * kFrameNs;
    drive.addScan(0, scanStreet(stamp));
    if (i % kImageEvery == 0) drive.addImage(0, stamp, takeImage);
    if (!parameters.class_topic.empty() && i >= kClassesLate && i % kImageEvery == 0)
      drive.addClasses(0, stamp - kClassesLate * kFrameNs,
                       toClassImage(cv::Mat(kRows, kColumns, CV_8U, cv::Scalar(kClassId)), map));
    drive.addPose({stamp, Pose(Eigen::Quaterniond::Identity(), Vector3d(0.1 * i, 0.0, 0.0))});
  }
  return bytes;
}

TEST(ParameterEffects, EachParameterChangesTheLabels) {
  const std::string model = ::testing::TempDir() + "effects.labels", classes = ::testing::TempDir() + "effects.csv";
  urban_nav_core::writeAtomically(model, printModel(testing::trainOnYards(ClassifierKind::Boosted)));
  urban_nav_core::writeAtomically(classes, "id,class\n" + std::to_string(kClassId) + ",paved\n");
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      table(),
      {{"drive past a wall",
        labelDrive,
        {{"model", model},
         {"precision", 0.5},
         {"superpixel", 40},
         {"spacing", 1.0},
         {"projection_distance", 4.0},
         {"class_topic", "classes"}},
        {{"projection_distance", 3.0}}},
       {"drive with class images",
        labelDrive,
        {{"class_file", classes}, {"class_accuracy", 0.99}},
        {{"class_topic", "classes"}, {"projection_distance", 3.0}}}},
      {{"samples", "Labels.OfABagAreThoseOfItsReturnsWhateverItsTruth", "../src/urban_nav/test"}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace scene_labeler
