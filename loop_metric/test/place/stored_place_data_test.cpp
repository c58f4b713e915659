// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/place/stored_place_data.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::OdometryChain;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_registration::Keyframe;
using urban_nav_registration::KeyframePoint;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::toStoredKeyframe;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr StampNs kRowSecond = 1'000'000'000;

Keyframe someKeyframe(StampNs stamp) {
  Keyframe keyframe;
  keyframe.at = {"day", stamp};
  keyframe.image = {1, 2, 3, 4};
  keyframe.width = 64;
  keyframe.height = 48;
  KeyframePoint point;
  point.u = 5;
  point.v = 7;
  point.disparity = 3.5F;
  keyframe.points = {point};
  return keyframe;
}

/// 40 s straight ahead at 1 m/s, a keyframe every 2 m, and a laser 1 m above base_link that always measures one point 2
/// m to its left.
class StoredSurroundingsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("loop_metric_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    store_.emplace((folder_ / "store.db").string(), Access::Write);
    store_->sessions().put(urban_nav_store::Session{id_, "day", "", "", 0, true});
    auto odometry = std::make_shared<OdometryChain>();
    for (int i = 0; i < 40; ++i) {
      urban_nav_core::RelativePose step;
      step.from = i * kRowSecond;
      step.to = (i + 1) * kRowSecond;
      step.T_from_to = Pose(urban_nav_core::Quaterniond::Identity(), {1.0, 0.0, 0.0});
      step.covariance *= 1e-6;
      odometry->append(step);
      if (i % 2 == 0) store_->keyframes().put(id_, kKeyframeCamera, toStoredKeyframe(someKeyframe(step.from)));
      urban_nav_core::Scan scan;
      scan.stamp = step.from;
      scan.beams.push_back({step.from, Eigen::Vector3f::UnitY(), 2.0F, 10.0F});
      store_->scans().put(id_, "laser_left", scan);
    }
    store_->commit();
    StoredSession session;
    session.id = id_;
    session.odometry = odometry;
    session.lasers.push_back({"laser_left", Pose(urban_nav_core::Quaterniond::Identity(), {0.0, 0.0, 1.0})});
    place_data_.emplace(StoredPlaceData::Sessions{{"day", session}}, store_->keyframes(), store_->scans());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  const urban_nav_store::SessionId id_ = "00112233445566778899";
  std::filesystem::path folder_;
  std::optional<Store> store_;
  std::optional<StoredPlaceData> place_data_;
};

TEST_F(StoredSurroundingsTest, KeyframesAroundAMomentInOrder) {
  const auto views = place_data_->views({"day", 10 * kRowSecond + kRowSecond / 2}, 4.0);
  ASSERT_EQ(views.size(), 4U);  // at 8, 10, 12 and 14 m; the one at 6 m is 4.5 m away
  EXPECT_EQ(views.front().at.stamp, 8 * kRowSecond);
  EXPECT_NEAR(views.front().path_offset, -2.5, 1e-9);
  EXPECT_NEAR(views.back().T_place_keyframe.pose.t().x(), 3.5, 1e-9);
  EXPECT_TRUE(place_data_->views({"another", 0}, 4.0).empty());
}

TEST_F(StoredSurroundingsTest, KeyframesComeBackAsTheyWere) {
  const Keyframe keyframe = place_data_->keyframe({"day", 4 * kRowSecond});
  EXPECT_EQ(keyframe.image, someKeyframe(0).image);
  EXPECT_EQ(keyframe.width, 64);
  EXPECT_EQ(keyframe.at, (urban_nav_core::PoseRef{"day", 4 * kRowSecond}));
  ASSERT_EQ(keyframe.points.size(), 1U);
  EXPECT_EQ(keyframe.points[0].disparity, 3.5F);
  EXPECT_TRUE(place_data_->keyframe({"day", 5 * kRowSecond}).points.empty());  // no keyframe is stored there
}

TEST_F(StoredSurroundingsTest, ADamagedKeyframeIsNamed) {
  urban_nav_store::StoredKeyframe stored = toStoredKeyframe(someKeyframe(8 * kRowSecond));
  stored.features[stored.features.size() / 2] ^= 1;
  store_->keyframes().put(id_, kKeyframeCamera, stored);
  EXPECT_THROW(place_data_->keyframe({"day", 8 * kRowSecond}), urban_nav_core::DataError);
}

TEST_F(StoredSurroundingsTest, ACloudHasTheScansAroundTheMomentInItsFrame) {
  const auto cloud = place_data_->cloud({"day", 20 * kRowSecond}, 3.0);
  ASSERT_EQ(cloud.points.size(), 7U);
  ASSERT_EQ(cloud.origins.size(), 7U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_TRUE(cloud.origins[i].isApprox(Eigen::Vector3f(static_cast<float>(i) - 3.0F, 0.0F, 1.0F), 1e-5F));
    EXPECT_NEAR(cloud.points[i].x(), static_cast<float>(i) - 3.0F, 1e-5F);
    EXPECT_NEAR(cloud.points[i].y(), 2.0F, 1e-5F);
    EXPECT_NEAR(cloud.points[i].z(), 1.0F, 1e-5F);
  }
  EXPECT_TRUE(place_data_->cloud({"day", 900 * kRowSecond}, 3.0).points.empty());
}

// Nine steps of 1 mm and 1 mrad to each side of the centre: 9 mm2 along and 9 mrad2 about each axis, the latter at 10 m
// and across the path; a third of the sum of the three axes, and of that a third.
TEST_F(StoredSurroundingsTest, OdometrysDriftBendsACloud) {
  EXPECT_NEAR(place_data_->deformationSigma({"day", 20 * kRowSecond}, 9.0), 0.019, 0.0015);
  EXPECT_LT(place_data_->deformationSigma({"day", 20 * kRowSecond}, 4.0), 0.014);
  EXPECT_EQ(place_data_->deformationSigma({"day", 900 * kRowSecond}, 4.0), 0.0);
  EXPECT_EQ(place_data_->deformationSigma({"night", 0}, 4.0), 0.0);
}

TEST_F(StoredSurroundingsTest, HasItsMomentsAndThePathBetweenThem) {
  std::string why;
  EXPECT_TRUE(place_data_->knows({"day", kRowSecond / 2}, why));
  EXPECT_FALSE(place_data_->knows({"day", 90 * kRowSecond}, why));
  EXPECT_NE(why.find("no frames around"), std::string::npos);
  EXPECT_FALSE(place_data_->knows({"night", 0}, why));
  EXPECT_NE(why.find("there are: day"), std::string::npos);
  const auto path = place_data_->between({"day", 30 * kRowSecond}, {"day", 10 * kRowSecond});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->T_a_b.pose.t().x(), -20.0, 1e-9);
  EXPECT_NEAR(path->length, 20.0, 1e-9);
  EXPECT_FALSE(place_data_->between({"day", 0}, {"night", 0}));
}

}  // namespace
}  // namespace loop_metric
