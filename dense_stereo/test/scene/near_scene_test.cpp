// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/near_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/rendered_pair.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace dense_stereo {
namespace {

using testing_support::RenderedPair;

TEST(NearScene, HasDisparitiesPointsAndTheGroundOfARoom) {
  const RenderedPair view(urban_nav_core::testing::texturedRoom(), -2.0, 0.5, 0.9, 0.17, 0.05);
  NearSceneEstimator estimator(Parameters(), view.camera());
  const NearScene& scene = estimator.process(view.pair());
  EXPECT_GT(scene.stereo.answered, 0.9);
  ASSERT_TRUE(scene.ground.isFound()) << scene.ground.sentence;
  EXPECT_NEAR(scene.ground.height, view.height(), 0.01);
  EXPECT_GT(scene.near_share, 0.1);
  EXPECT_LE(scene.near_share, 1.0);
  for (const DensePoint& point : scene.points) EXPECT_LE(point.p_cam.norm(), 5.001F);
}

TEST(NearScene, OfAPairWithoutAnImageIsEmpty) {
  const RenderedPair view(urban_nav_core::testing::texturedRoom(), -2.0, 0.5, 0.9, 0.17, 0.05);
  NearSceneEstimator estimator(Parameters(), view.camera());
  estimator.process(view.pair());
  urban_nav_core::StereoPair one_sided = view.pair();
  one_sided.right = {};
  const NearScene& scene = estimator.process(one_sided);
  EXPECT_EQ(scene.stereo.status.health, urban_nav_core::Health::Lost);
  EXPECT_TRUE(scene.points.empty());
  EXPECT_TRUE(scene.obstacles.empty());
  EXPECT_FALSE(scene.ground.isFound());
  EXPECT_EQ(scene.near_share, 0.0);
}

TEST(NearScene, ReachesFartherWithALongerBaseline) {
  urban_nav_core::StereoCamera camera;
  camera.left = {390.0, 390.0, 255.5, 191.5, 512, 384};
  camera.baseline = 0.12;
  EXPECT_EQ(rangeLimit(5.0, camera), 5.0);
  EXPECT_EQ(rangeLimit(8.0, camera), 8.0);
  camera.left.fx = 720.0;
  camera.baseline = 0.54;
  EXPECT_NEAR(rangeLimit(5.0, camera), 13.9, 0.1);
}

TEST(ThinPoints, KeepsTheMostCertainPointOfEachCube) {
  const auto pointAt = [](float x, float variance) {
    DensePoint point;
    point.p_cam = {x, 0.01F, 2.01F};
    point.disparity = 20.0F;
    point.variance = variance;
    return point;
  };
  const std::vector<DensePoint> thinned =
      thinPoints({pointAt(0.11F, 0.04F), pointAt(0.14F, 0.01F), pointAt(0.12F, 0.09F), pointAt(-0.01F, 0.25F)}, 0.1);
  ASSERT_EQ(thinned.size(), 2U);
  EXPECT_EQ(thinned[0].variance, 0.01F);
  EXPECT_EQ(thinned[1].p_cam.x(), -0.01F) << "cubes do not meet at zero";
  EXPECT_TRUE(thinPoints({}, 0.1).empty());
}

}  // namespace
}  // namespace dense_stereo
