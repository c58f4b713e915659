// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scene_labeler/drive/drive_labeler.hpp"
#include "scene_labeler/drive/travelled_path.hpp"
#include "support/yard.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

DriveReturn returnAt(std::size_t number, double travelled) {
  DriveReturn one;
  one.scan = static_cast<StampNs>(number);
  one.travelled = travelled;
  one.point = Eigen::Vector3f(static_cast<float>(travelled), 2.0F, 0.0F);
  return one;
}

/// Records the frames with their returns.
struct Notes : DriveObserver {
  std::map<double, std::pair<std::size_t, std::size_t>> seen;  // frame: first and last index
  std::map<double, Stretch> nearest;
  std::size_t settled = 0;

  void observe(const DriveFrame& frame, const Stretch& stretch, std::size_t first,
               const std::vector<DriveReturn>& returns) override {
    EXPECT_LE(settled, first) << "a finished return is visible again";
    seen[frame.travelled] = {first, first + returns.size() - 1};
    nearest[frame.travelled] = stretch;
    for (const DriveReturn& one : returns) EXPECT_LE(std::abs(one.travelled - frame.travelled), 3.0);
  }
  void settle(std::size_t end) override {
    EXPECT_GE(end, settled);
    settled = end;
  }
};

TEST(DriveWindow, BringsToEachFrameTheReturnsWithinReachAndSettlesAll) {
  Notes notes;
  DriveWindow window(3.0, notes);
  for (std::size_t i = 0; i < 200; ++i) {
    const double travelled = 0.1 * static_cast<double>(i);
    if (i % 50 == 20) window.add(DriveFrame{static_cast<StampNs>(i), travelled, {}});
    window.add(returnAt(i, travelled));
  }
  window.finish();
  ASSERT_EQ(notes.seen.size(), 4u);
  EXPECT_EQ(notes.seen.at(2.0), std::make_pair(std::size_t{0}, std::size_t{50}));
  EXPECT_EQ(notes.seen.at(0.1 * 70.0), std::make_pair(std::size_t{40}, std::size_t{100}));
  EXPECT_EQ(notes.settled, 200u);
  EXPECT_TRUE(notes.nearest.at(2.0).holds(0.0));
  EXPECT_TRUE(notes.nearest.at(2.0).holds(4.4));
  EXPECT_FALSE(notes.nearest.at(2.0).holds(4.6));
  EXPECT_TRUE(notes.nearest.at(0.1 * 170.0).holds(1e6));
}

TEST(TravelledPath, DoesNotGrowWhileTheRobotIsStationary) {
  Trajectory trajectory;
  for (int i = 0; i < 100; ++i) {
    const double x = i < 50 ? 0.01 * (i % 2) : 0.1 * (i - 50);
    trajectory.append(i, Pose(Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}));
  }
  const TravelledPath path(trajectory);
  EXPECT_EQ(path.at(49), 0.0);
  EXPECT_NEAR(*path.at(99), 4.9, 1e-9);
  EXPECT_FALSE(path.at(100));
  EXPECT_FALSE(path.at(-1));
}

TEST(DriveLabeler, LabelsEachReturnOnceAsItsPlaceShows) {
  const testing::Yard yard = testing::makeYard(21);
  std::vector<std::pair<DriveReturn, SceneClass>> drive;
  for (std::size_t i = 0; i < yard.labels.size(); ++i) {
    DriveReturn one;
    one.beam = static_cast<std::uint16_t>(i);
    one.point = yard.scene.points[i];
    one.travelled = std::floor(static_cast<double>(one.point.y()) * 10.0) / 10.0;
    drive.emplace_back(one, yard.labels[i]);
  }
  std::stable_sort(drive.begin(), drive.end(),
                   [](const auto& a, const auto& b) { return a.first.travelled < b.first.travelled; });
  std::vector<std::uint8_t> answers(yard.labels.size(), 0);
  std::size_t right = 0;
  DriveLabeler labeler(testing::trainOnYards(ClassifierKind::Boosted), Parameters(),
                       [&](const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
                         ASSERT_EQ(returns.size(), labels.labels.size());
                         for (std::size_t i = 0; i < returns.size(); ++i) {
                           ++answers[returns[i].beam];
                           right += labels.labels[i] == yard.labels[returns[i].beam] ? 1U : 0U;
                         }
                       });
  DriveWindow window(6.0, labeler);
  for (const double travelled : {1.0, 4.0, 7.0}) window.add(DriveFrame{0, travelled, {}});
  for (const auto& [one, label] : drive) window.add(one);
  window.finish();
  EXPECT_EQ(labeler.frames(), 3u);
  EXPECT_EQ(std::count(answers.begin(), answers.end(), 1), static_cast<std::ptrdiff_t>(answers.size()));
  EXPECT_GT(right, answers.size() * 85 / 100);
}

TEST(DriveLabeler, TakesTheImagesOfACoveredOrDazzledCameraForNone) {
  const testing::Yard yard = testing::makeYard(22);
  for (const int brightness : {0, 255}) {
    std::vector<SceneClass> answers;
    DriveLabeler labeler(testing::trainOnYards(ClassifierKind::Boosted), Parameters(),
                         [&](const std::vector<DriveReturn>&, const SceneLabels& labels) { answers = labels.labels; });
    DriveWindow window(100.0, labeler);
    SideView view;
    view.camera.pinhole = {100.0, 100.0, 50.0, 40.0, 101, 81};
    view.image = cv::Mat(81, 101, CV_8UC3, cv::Scalar::all(brightness));
    window.add(DriveFrame{0, 0.0, view});
    for (const Eigen::Vector3f& point : yard.scene.points) {
      DriveReturn one;
      one.point = point;
      window.add(one);
    }
    window.finish();
    EXPECT_EQ(labeler.blindFrames(), 1u);
    EXPECT_EQ(labeler.imagedFrames(), 0u);
    ASSERT_EQ(answers.size(), yard.labels.size());
    std::size_t right = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) right += answers[i] == yard.labels[i] ? 1U : 0U;
    EXPECT_GT(right, answers.size() * 9 / 10) << "by shape";
  }
}

TEST(DriveLabeler, CountsAClassImageOfAnotherSourceAsAView) {
  const testing::Yard yard = testing::makeYard(23);
  Parameters parameters;
  parameters.class_accuracy = 0.99;
  SideView view;  // at the ground, from above
  view.camera.pinhole = {40.0, 40.0, 50.0, 40.0, 101, 81};
  Eigen::Matrix3d R_world_camera;
  R_world_camera << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  view.T_world_camera = Pose(Eigen::Quaterniond(R_world_camera), {4.0, 4.0, 6.0});
  view.image = cv::Mat(81, 101, CV_8UC3, cv::Scalar(90, 110, 120));
  const auto sumFoliage = [&](const cv::Mat& classes) {  // sum of probabilities
    float sum = 0.0F;
    DriveLabeler labeler(testing::trainOnYards(ClassifierKind::Boosted), parameters,
                         [&](const std::vector<DriveReturn>&, const SceneLabels& labels) {
                           const auto foliage =
                               std::find(labels.classes.begin(), labels.classes.end(), SceneClass::Foliage);
                           const std::size_t classes_of_model = labels.classes.size();
                           for (auto i = static_cast<std::size_t>(foliage - labels.classes.begin());
                                i < labels.probabilities.size(); i += classes_of_model)
                             sum += labels.probabilities[i];
                         });
    DriveWindow window(100.0, labeler);
    view.classes = classes;
    window.add(DriveFrame{0, 0.0, view});
    for (const Eigen::Vector3f& point : yard.scene.points) {
      DriveReturn one;
      one.point = point;
      window.add(one);
    }
    window.finish();
    EXPECT_EQ(labeler.classFrames(), classes.size() == view.image.size() ? 1U : 0U);
    return sum;
  };
  const auto with = [](int scene_class) { return cv::Mat(81, 101, CV_8U, cv::Scalar(scene_class)); };
  const float without = sumFoliage({});
  EXPECT_GT(sumFoliage(with(6)), without + 100.0F);
  EXPECT_EQ(sumFoliage(with(255)), without) << "the source states no classes";
  EXPECT_EQ(sumFoliage(with(1)), without) << "a class unknown to the model";
  EXPECT_EQ(sumFoliage(cv::Mat(10, 10, CV_8U, cv::Scalar(6))), without) << "another size";
}

TEST(DriveScene, ProjectsThroughTheLensAndThinsToOneReturnPerCube) {
  SideView view;
  view.camera.pinhole = {100.0, 100.0, 50.0, 40.0, 101, 81};
  view.T_world_camera = Pose(Eigen::Quaterniond::Identity(), {1000.0, 0.0, 0.0});
  view.image = cv::Mat(81, 101, CV_8UC3, cv::Scalar(10, 100, 200));
  std::vector<DriveReturn> returns(3);
  returns[0].point = {1000.01F, 0.01F, 2.01F};
  returns[1].point = {1000.02F, 0.02F, 2.02F};
  returns[2].point = {1000.51F, 0.0F, 2.0F};
  const DriveScene drive = makeDriveScene(returns, view);
  ASSERT_EQ(drive.scene.points.size(), 2u);
  EXPECT_EQ(drive.point_of_return, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_NEAR(drive.scene.view.pixels[1].x(), 75.5F, 0.1F);
  EXPECT_NEAR(drive.scene.view.depths[1], 2.0F, 1e-3F);
}

}  // namespace
}  // namespace scene_labeler
