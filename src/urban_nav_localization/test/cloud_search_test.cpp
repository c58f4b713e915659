// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/cloud_search.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>

#include "urban_nav_core/testing/scanner.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::RelativePose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::testing::Scanner;
using urban_nav_core::testing::World;
using urban_nav_registration::Keyframe;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::LaserScans;
using urban_nav_registration::localCloud;
using urban_nav_registration::toStoredKeyframe;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr double kPerStep = 0.1;              // m
constexpr StampNs kPeriod = 100'000'000;      // ns
constexpr StampNs kDay = 86'400'000'000'000;  // ns
constexpr int kFrames = 280;

/// Poses of a drive through a courtyard, and of the way back on another day, 1.5 m to the side.
Pose there(int i) { return Pose(Eigen::Quaterniond::Identity(), {kPerStep * i - 14.0, -0.75, 0.0}); }
Pose back(int i) {
  return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(3.14159265358979, Eigen::Vector3d::UnitZ())),
              {14.0 - kPerStep * i, 0.75, 0.0});
}

/// Beams that are thrown up and down on both sides of the robot, a little forward, so that fronts across the way are
/// seen too.
Scan scanAt(const World& world, const Pose& T_world_laser, StampNs stamp) {
  Scanner scanner;
  scanner.rings = 1;
  scanner.beams = 360;
  scanner.lowest = 0.0;
  scanner.sigma = 0.01;
  Scan scan;
  scan.stamp = stamp;
  for (const Eigen::Vector3f& p :
       urban_nav_core::testing::scan(world, T_world_laser, scanner, static_cast<std::uint64_t>(stamp / kPeriod)).points)
    scan.beams.push_back({stamp, p.normalized(), p.norm(), 1.0F});
  return scan;
}

Pose laser(double heading) {
  Eigen::Matrix3d R;
  R.col(0) << std::cos(heading), std::sin(heading), 0.0;
  R.col(1) = Eigen::Vector3d::UnitZ();
  R.col(2) = R.col(0).cross(R.col(1));
  return Pose(R, {0.0, 0.0, 1.0});
}

RelativePose stepTo(int i, const Pose& before, const Pose& now, StampNs since) {
  RelativePose step;
  step.from = since + (i - 1) * kPeriod;
  step.to = since + i * kPeriod;
  step.T_from_to = before.inverse() * now;
  step.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
  step.source = "swf_vo";
  return step;
}

class CloudSearchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("cloud_search_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  /// The first day.
  void map(const World& world, bool scans = true) {
    store_.emplace((folder_ / "store.db").string(), Access::Write);
    store_->sessions().put(urban_nav_store::Session{id_, "first", "", "", 0, true});
    Keyframe keyframe;  // a map without any view is none
    keyframe.width = keyframe.height = 1;
    store_->keyframes().put(id_, kKeyframeCamera, toStoredKeyframe(keyframe));
    for (std::size_t l = 0; l < 2; ++l)
      store_->sessions().put(id_, urban_nav_store::Extrinsic{"laser_" + std::to_string(l), lasers_[l]});
    for (int i = 0; i < kFrames; ++i) {
      urban_nav_store::Node node{i * kPeriod, there(0).inverse() * there(i)};
      if (i > 0) node.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
      store_->graph().put(id_, node);
      for (std::size_t l = 0; scans && l < 2; ++l)
        store_->scans().put(id_, "laser_" + std::to_string(l), scanAt(world, there(i) * lasers_[l], i * kPeriod));
    }
    store_->commit();
    frozen_.emplace(*store_);
    search_.emplace(Parameters(), *frozen_, *store_);
    while (search_->readNext()) {
    }
  }
  /// The second one, up to a frame.
  void drive(const World& world, int last) {
    for (; driven_ <= last; ++driven_) {
      const StampNs stamp = kDay + driven_ * kPeriod;
      ASSERT_TRUE(driven_ == 0 || localiser_.addOdometry(stepTo(driven_, back(driven_ - 1), back(driven_), kDay)));
      for (std::size_t l = 0; l < 2; ++l) scans_[l].push_back(scanAt(world, back(driven_) * lasers_[l], stamp));
      const auto stretch = search_->due(localiser_, BeamSources::PlanarLasers);
      if (!stretch) continue;
      ++looks_;
      EXPECT_GE(stretch->way, 3.0);
      const auto cloud = localCloud(localiser_.odometry(), stretch->at, stretch->way, live());
      matches_ += search_->query(*stretch, cloud, 0.01, localiser_) ? 1 : 0;
      EXPECT_FALSE(search_->due(localiser_, BeamSources::PlanarLasers)) << "once each some metres";
    }
  }
  std::vector<LaserScans> live() const {
    std::vector<LaserScans> lasers;
    for (std::size_t l = 0; l < 2; ++l)
      lasers.push_back({lasers_[l], [this, l](StampNs first, StampNs last, const auto& take) {
                          for (const Scan& scan : scans_[l])
                            if (scan.stamp >= first && scan.stamp <= last) take(scan);
                        }});
    return lasers;
  }

  const std::string id_ = "0123456789abcdef0123";
  const std::vector<Pose> lasers_ = {laser(0.6), laser(0.7 - 3.14159265358979)};
  std::filesystem::path folder_;
  std::optional<Store> store_;
  std::optional<FrozenMap> frozen_;
  std::optional<CloudSearch> search_;
  Localiser localiser_{Parameters()};
  std::vector<std::vector<Scan>> scans_{2};
  int driven_ = 0, looks_ = 0, matches_ = 0;
};

TEST_F(CloudSearchTest, FindsARobotInTheOppositeDirection) {
  const World world = urban_nav_core::testing::courtyard(4);
  map(world);
  EXPECT_EQ(search_->places(), 6U) << "28 m";
  drive(world, 55);
  EXPECT_EQ(looks_, 0) << "less than six metres are too few";
  drive(world, kFrames - 1);
  EXPECT_GE(looks_, 5);
  EXPECT_GE(matches_, 3);
  const LocalizationEstimate estimate = localiser_.now();
  ASSERT_EQ(estimate.state, LocalizationState::Localized) << estimate.sentence;
  const Pose truth = there(0).inverse() * back(kFrames - 1);
  EXPECT_LT(distanceBetween(estimate.T_map_base->pose, truth), 0.1);
  EXPECT_LT(angleBetween(estimate.T_map_base->pose, truth), 0.01);
}

// Two similar courtyards: clouds of one fit the other with an overlap of 0.4.
TEST_F(CloudSearchTest, FindsNoMatchInAnotherCourtyard) {
  map(urban_nav_core::testing::courtyard(4));
  for (const std::uint64_t seed : {13U, 26U}) {
    localiser_ = Localiser(Parameters());
    for (auto& scans : scans_) scans.clear();
    driven_ = looks_ = matches_ = 0;
    drive(urban_nav_core::testing::courtyard(seed), 220);
    EXPECT_GE(looks_, 5);
    EXPECT_LE(matches_, 2) << seed;
    EXPECT_NE(localiser_.now().state, LocalizationState::Localized) << seed << ": " << localiser_.now().sentence;
  }
}

TEST_F(CloudSearchTest, SearchesNothingWithoutScansOfTheMapOrWhileMatched) {
  const World world = urban_nav_core::testing::courtyard(4);
  map(world, false);
  EXPECT_EQ(search_->places(), 0U);
  drive(world, 150);
  EXPECT_EQ(looks_, 0);
}

TEST_F(CloudSearchTest, AStretchWithoutBeamsIsNoMatch) {
  const World world = urban_nav_core::testing::courtyard(4);
  map(world);
  for (int i = 1; i <= 80; ++i) ASSERT_TRUE(localiser_.addOdometry(stepTo(i, back(i - 1), back(i), kDay)));
  const auto stretch = search_->due(localiser_, BeamSources::PlanarLasers);
  ASSERT_TRUE(stretch);
  EXPECT_NEAR(stretch->way, 4.0, 0.2) << "all there is";
  EXPECT_FALSE(search_->query(*stretch, {}, 0.01, localiser_));
  EXPECT_FALSE(search_->due(localiser_, BeamSources::PlanarLasers)) << "it was looked for";
  EXPECT_FALSE(localiser_.now().T_map_base);
}

}  // namespace
}  // namespace urban_nav_localization
