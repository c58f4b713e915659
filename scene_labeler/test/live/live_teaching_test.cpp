// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_teaching.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "support/yard.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

DriveScene toDrive(const testing::Yard& yard, const Eigen::Vector3f& origin) {
  DriveScene drive;
  drive.scene = yard.scene;
  drive.origin = origin;
  return drive;
}

/// Waits for the training, at most a minute.
std::optional<LabelModel> taughtModel(LiveTeaching& teaching) {
  for (int i = 0; i < 6000; ++i) {
    if (std::optional<LabelModel> taught = teaching.takeTaught()) return taught;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return std::nullopt;
}

class Teacher : public ::testing::Test {
 protected:
  static std::shared_ptr<const LabelModel> base() {
    return std::make_shared<const LabelModel>(testing::trainOnYards(ClassifierKind::Boosted));
  }
  const Eigen::Vector3f origin_{100.0F, -50.0F, 3.0F};
  const testing::Yard yard_ = testing::makeYard(7);
  Parameters parameters_;
};

TEST_F(Teacher, TrainsOnAThreadAndAddsLaterCorrectionsAfterwards) {
  LiveTeaching teaching(parameters_, base());
  EXPECT_FALSE(teaching.takeTaught());
  teaching.keep(toDrive(yard_, origin_));
  teaching.correct(origin_ + yard_.scene.points[10], SceneClass::Grass);
  teaching.correct(origin_ + yard_.scene.points[500], SceneClass::Grass);
  EXPECT_TRUE(teaching.isTraining());
  const auto first = taughtModel(teaching);
  ASSERT_TRUE(first);
  EXPECT_TRUE(teaching.isTraining()) << "the second correction arrived during training";
  const auto second = taughtModel(teaching);
  ASSERT_TRUE(second);
  EXPECT_FALSE(teaching.isTraining());
  const auto corrected = [](const LabelModel& model) {
    return std::count_if(model.samples.weights.begin(), model.samples.weights.end(),
                         [](int weight) { return weight > 1; });
  };
  EXPECT_GT(corrected(*first), 0);
  EXPECT_GT(corrected(*second), corrected(*first));
}

TEST_F(Teacher, RejectsUnusableCorrections) {
  LiveTeaching teaching(parameters_, base());
  EXPECT_THROW(teaching.correct(origin_, SceneClass::Grass), urban_nav_core::UserError) << "no frame";
  teaching.keep(toDrive(yard_, origin_));
  EXPECT_THROW(teaching.correct(origin_ + Eigen::Vector3f(0, 0, 50), SceneClass::Grass), urban_nav_core::UserError);
  EXPECT_FALSE(teaching.isTraining());
  LabelModel empty = testing::trainOnYards(ClassifierKind::Boosted);
  empty.samples = {};
  LiveTeaching without(parameters_, std::make_shared<const LabelModel>(empty));
  without.keep(toDrive(yard_, origin_));
  EXPECT_THROW(without.correct(origin_ + yard_.scene.points[10], SceneClass::Grass), urban_nav_core::UserError);
}

TEST_F(Teacher, EndsWhileItTrains) {
  LiveTeaching teaching(parameters_, base());
  teaching.keep(toDrive(yard_, origin_));
  teaching.correct(origin_ + yard_.scene.points[10], SceneClass::Grass);
}

}  // namespace
}  // namespace scene_labeler
