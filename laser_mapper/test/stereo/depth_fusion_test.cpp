// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/depth_fusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/rendered_depth.hpp"

namespace laser_mapper {
namespace {

using testing_room::Scene;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

constexpr float kNoise = 0.3F;  // px

/// Depth images of a drive of 0.4 m steps towards the wall at x = 10 m.
class DepthFusion : public ::testing::Test {
 protected:
  void drive(int images, const std::function<Scene(int image)>& makeScene) {
    for (int i = 0; i < images; ++i) {
      const Pose T_map_base(Eigen::Quaterniond::Identity(), Vector3d(0.4 * i, 0.0, 0.0));
      frames_.push_back(std::make_unique<DepthFrame>(
          depthFrame(testing_room::depthOfScene(makeScene(i), T_map_base, i, kNoise, static_cast<unsigned>(i)))));
      posed_.push_back({frames_.back().get(), T_map_base * testing_room::roomCamera()});
    }
  }
  std::vector<double> errors(const std::vector<FusedPoint>& points) const {
    std::vector<double> found;
    for (const FusedPoint& point : points) found.push_back(testing_room::distanceToRoom(point.p.cast<double>()));
    std::sort(found.begin(), found.end());
    return found;
  }
  static Scene room() { return testing_room::rangeInRoom; }

  std::vector<std::unique_ptr<DepthFrame>> frames_;
  std::vector<PosedDepth> posed_;
};

TEST_F(DepthFusion, AveragesWhatImagesAgreeOn) {
  drive(6, [&](int) { return room(); });
  FusionRule one, all;
  one.fewest_views = 1;
  one.sigma_limit = all.sigma_limit = 1.0F;
  const std::vector<double> single = errors(fuseDepth(posed_[2], {}, one));
  const std::vector<FusedPoint> points = fuseDepth(posed_[2], posed_, all);
  const std::vector<double> fused = errors(points);
  ASSERT_GT(fused.size(), 10'000U);
  EXPECT_LT(fused[fused.size() / 2], 0.6 * single[single.size() / 2]);
  EXPECT_LT(fused[fused.size() * 95 / 100], 0.6 * single[single.size() * 95 / 100]);
  for (const FusedPoint& point : points) {
    ASSERT_GE(point.views, 3);
    ASSERT_GT(point.sigma, 0.0F);
    ASSERT_EQ(point.grey, 120.0F);
  }
}

TEST_F(DepthFusion, LeavesOutPointsOfTooFewImages) {
  drive(2, [&](int) { return room(); });
  EXPECT_TRUE(fuseDepth(posed_[0], posed_, {}).empty());
  FusionRule two;
  two.fewest_views = 2;
  EXPECT_FALSE(fuseDepth(posed_[0], posed_, two).empty());
}

TEST_F(DepthFusion, LeavesOutPointsThatOthersSeeThrough) {
  // An object is at x = 6 m in the first three of nine images.
  const Scene with_thing = [](const Vector3d& origin, const Vector3d& direction) {
    const double wall = testing_room::rangeInRoom(origin, direction), t = (6.0 - origin.x()) / direction.x();
    const Vector3d at = origin + t * direction;
    return t > 0.0 && std::abs(at.y()) < 0.4 && at.z() > 0.6 && at.z() < 1.8 ? std::min(t, wall) : wall;
  };
  drive(9, [&](int image) { return image < 3 ? with_thing : room(); });
  std::size_t on_thing = 0;
  for (const FusedPoint& point : fuseDepth(posed_[1], posed_, {}))
    on_thing += testing_room::distanceToRoom(point.p.cast<double>()) > 0.5 ? 1 : 0;
  EXPECT_EQ(on_thing, 0U);
}

TEST_F(DepthFusion, KeepsToItsLimits) {
  drive(6, [&](int) { return room(); });
  FusionRule rule;
  rule.sigma_limit = 0.03F;
  rule.farthest = 6.0F;
  const std::vector<FusedPoint> points = fuseDepth(posed_[2], posed_, rule);
  ASSERT_FALSE(points.empty());
  for (const FusedPoint& point : points) {
    EXPECT_LE(point.sigma, 0.03F);
    EXPECT_LT((point.p.cast<double>() - posed_[2].T_frame_camera.t()).x(), 6.3);
  }
}

}  // namespace
}  // namespace laser_mapper
