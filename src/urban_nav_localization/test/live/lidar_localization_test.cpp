// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "live/live_localiser.hpp"
#include "urban_nav_core/testing/scanner.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::RelativePose;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;
using urban_nav_core::testing::Scanner;
using urban_nav_core::testing::World;
using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::Store;
using urban_nav_store::TableStore;

constexpr double kFrameDistance = 0.1;             // m
constexpr StampNs kFramePeriod = 100'000'000;      // ns
constexpr StampNs kLaterDay = 86'400'000'000'000;  // ns
constexpr int kFramesOfADay = 280;
const char* const kMappedDay = "0123456789abcdef0123";
const char* const kLidarFrame = "velodyne";

Pose mounting() { return Pose(Eigen::Quaterniond::Identity(), {0.2, 0.0, 1.6}); }

/// Poses of a drive through a courtyard, and of the return, 1.5 m to the side.
Pose outward(int i) { return Pose(Eigen::Quaterniond::Identity(), {kFrameDistance * i - 14.0, -0.75, 0.0}); }
Pose homeward(int i) {
  return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ())),
              {14.0 - kFrameDistance * i, 0.75, 0.0});
}

Sweep sweepAt(const World& world, const Pose& T_world_base, StampNs stamp) {
  Scanner scanner;
  scanner.rings = 16;
  scanner.beams = 450;
  scanner.lowest = -15.0;
  scanner.highest = 15.0;
  Sweep sweep;
  sweep.reference = stamp;
  for (const Eigen::Vector3f& p : urban_nav_core::testing::scan(world, T_world_base * mounting(), scanner,
                                                                static_cast<std::uint64_t>(stamp / kFramePeriod))
                                      .points) {
    const double elevation = std::asin(static_cast<double>(p.z() / p.norm())) * 180.0 / M_PI;
    sweep.beams.push_back(
        {stamp, p.normalized(), p.norm(), 1.0F, static_cast<std::uint16_t>(std::lround((elevation + 15.0) / 2.0)), 0});
  }
  return sweep;
}

RelativePose makeStep(const Pose& before, const Pose& now, StampNs from) {
  RelativePose step;
  step.from = from;
  step.to = from + kFramePeriod;
  step.T_from_to = before.inverse() * now;
  step.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
  step.source = "laser_odometry";
  return step;
}

/// A robot with a 3D LiDAR and no camera, in the map of another drive.
class LidarLocalization : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = ::testing::TempDir() + "lidar_localization_" + std::to_string(::getpid()) + ".db";
    urban_nav_store::removeStore(path_);
  }
  void TearDown() override {
    localiser_.reset();
    urban_nav_store::removeStore(path_);
  }
  void map(const World& world) {
    {
      Store store(path_, urban_nav_store::Access::Write);
      store.sessions().put(urban_nav_store::Session{kMappedDay, "first", "", "", 0, true});
      TableStore<MountedLidar>(store).put({kMappedDay, "points0", kLidarFrame, mounting()});
      for (int i = 0; i < kFramesOfADay; ++i) {
        urban_nav_store::Node node{i * kFramePeriod, outward(0).inverse() * outward(i)};
        if (i > 0) node.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
        store.graph().put(kMappedDay, node);
        if (i % 3 == 0)
          TableStore<LidarSweep>(store).put({kMappedDay, "points0", i * kFramePeriod,
                                             LidarSweep::pack(sweepAt(world, outward(i), i * kFramePeriod))});
      }
      store.commit();
    }
    open();
  }
  void open() {
    Store store(path_, urban_nav_store::Access::Read);
    FrozenMap frozen(store);
    localiser_ = std::make_unique<LiveLocaliser>(
        Parameters(), std::move(store), std::move(frozen),
        []() -> std::shared_ptr<urban_nav_registration::KeyframeRetrieval> { return nullptr; },
        [this](const LocalizationEstimate& estimate, const std::optional<Pose>&) { published_.push_back(estimate); });
  }
  /// Drives homeward up to a frame, with time for all queries.
  void drive(const World& world, int last) {
    for (int i = 0; i <= last; ++i) {
      const StampNs stamp = kLaterDay + i * kFramePeriod;
      localiser_->addOdometry({stamp, homeward(0).inverse() * homeward(i)});
      localiser_->addSweep(kLidarFrame, sweepAt(world, homeward(i), stamp));
      for (const std::string& frame : localiser_->unplacedLasers()) localiser_->setLaser(frame, mounting());
      if (i > 0) localiser_->addStep(makeStep(homeward(i - 1), homeward(i), stamp - kFramePeriod));
      while (localiser_->work()) {
      }
      if (localized_after_ < 0.0 && localiser_->state().estimate.state == LocalizationState::Localized)
        localized_after_ = kFrameDistance * i;
    }
  }

  std::string path_;
  std::unique_ptr<LiveLocaliser> localiser_;
  std::vector<LocalizationEstimate> published_;
  double localized_after_ = -1.0;  // m; negative: never
};

TEST_F(LidarLocalization, FindsARobotInTheOppositeDirectionWithoutACamera) {
  const World world = urban_nav_core::testing::courtyard(4);
  map(world);
  EXPECT_TRUE(localiser_->unplacedLasers().empty());
  drive(world, kFramesOfADay - 1);
  const LiveLocaliser::State state = localiser_->state();
  EXPECT_EQ(state.map_fault, "");
  EXPECT_EQ(state.map_keyframes, 0U);
  EXPECT_EQ(state.queries, 0);
  EXPECT_GE(state.cloud_matches, 3);
  ASSERT_EQ(state.estimate.state, LocalizationState::Localized) << state.estimate.sentence;
  EXPECT_GT(localized_after_, 2.0);
  EXPECT_LT(localized_after_, 8.0) << "two places of the map match";
  const Pose truth = outward(0).inverse() * homeward(kFramesOfADay - 1);
  EXPECT_LT(distanceBetween(state.estimate.T_map_base->pose, truth), 0.1);
  EXPECT_LT(angleBetween(state.estimate.T_map_base->pose, truth), 0.01);
}

TEST_F(LidarLocalization, IsUnmappedInAnotherCourtyard) {
  map(urban_nav_core::testing::courtyard(4));
  drive(urban_nav_core::testing::courtyard(13), 120);
  EXPECT_GE(localiser_->state().cloud_queries, 5);
  EXPECT_LT(localized_after_, 0.0) << localiser_->state().estimate.sentence;
  EXPECT_EQ(localiser_->state().estimate.state, LocalizationState::Unmapped);
}

// Along a single front the position is not determined.
TEST_F(LidarLocalization, IsNotLocalizedAlongAFeaturelessFront) {
  map(urban_nav_core::testing::facade());
  drive(urban_nav_core::testing::facade(), 100);
  EXPECT_LT(localized_after_, 0.0) << localiser_->state().estimate.sentence;
}

}  // namespace
}  // namespace urban_nav_localization
