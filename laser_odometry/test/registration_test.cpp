// SPDX-License-Identifier: BSD-3-Clause
#include "registration.hpp"

#include <gtest/gtest.h>

#include "support/spinning_lidar.hpp"
#include "sweep_points.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace laser_odometry {
namespace {

struct Registered {
  SurfaceMap map{0.5, 3, 30.0};
  std::vector<Patch> patches;
};

/// A map of `world` from the origin, and the patches of a sweep from `T_world_base`; both without noise.
Registered prepare(const BoxWorld& world, const Pose& T_world_base) {
  SpinningLidar lidar;
  lidar.rings = 64;
  lidar.sigma_m = 0.0;
  const Pose T_world_odom(Eigen::Quaterniond::Identity(), {0, 0, 1.7});
  const auto still = [](const Pose& T) { return [T](double) { return T; }; };
  const SweepPoints first = collectPoints(lidar.scan(world, still(T_world_odom), 0, 1), {}, {1.0, 80.0, 1.0, 0.25});
  const SweepPoints second =
      collectPoints(lidar.scan(world, still(T_world_odom * T_world_base), 0, 1), {}, {1.0, 80.0, 1.0, 0.25});
  Registered all;
  all.map.insert(deskew(first, {}), Vector3d::Zero(), 0);
  all.patches = makePatches(deskew(second, {}), 0.5);
  return all;
}

TEST(Registration, TheJacobianIsTheDerivativeOfTheResidualAlsoFarFromTheSolution) {
  const Pose T(urban_nav_core::expSo3({0.1, -0.1, 0.5}), {0.5, -0.3, 0.2});
  Registered all = prepare(makeRoom(), Pose());
  const auto matches = matchPatches(all.patches, all.map, T, {}, 0.02, 0);
  ASSERT_GT(matches.size(), 20u);
  for (std::size_t i = 0; i < matches.size(); i += 5) {
    const PatchMatch& match = matches[i];
    const Vector3d p_base = T.inverse() * match.p_odom;
    const auto residual = [&](const Pose& pose) {
      return match.cell->plane.normal.dot(pose * p_base - match.cell->plane.mean);
    };
    EXPECT_NEAR(residual(T), match.residual, 1e-12);
    const auto J = urban_nav_core::testing::numericJacobian<1, 6>(
        [&](const Pose& pose) { return Eigen::Matrix<double, 1, 1>(residual(pose)); }, T);
    EXPECT_LT((J.transpose() - match.row.jacobian()).norm(), 1e-8);
  }
}

TEST(Registration, AnOffsetInARoomIsFound) {
  const Pose truth(urban_nav_core::expSo3({0.01, -0.02, 0.08}), {0.3, -0.2, 0.05});
  Registered all = prepare(makeRoom(), truth);
  RegistrationOptions options;
  options.iterations = 30;
  options.coarse_level = 2;
  const Registration found = registerPatches(all.patches, all.map, Pose(), Pose(), options);
  ASSERT_TRUE(found.solved);
  EXPECT_FALSE(found.free.isFree());
  EXPECT_LT(distanceBetween(found.T_odom_base, truth), 0.005);
  EXPECT_LT(angleBetween(found.T_odom_base, truth), 0.001);
}

TEST(Registration, AlongATunnelTheResultIsThatOfThePrior) {
  Registered all = prepare(makeTunnel(), Pose(Eigen::Quaterniond::Identity(), {0.4, 0.1, 0.0}));
  const Pose prior(Eigen::Quaterniond::Identity(), {0.25, 0.0, 0.0});
  const Registration found = registerPatches(all.patches, all.map, prior, Pose(), {});
  ASSERT_EQ(found.free.directions.size(), 1u);
  EXPECT_NEAR(found.T_odom_base.t().x(), 0.25, 1e-3);
  EXPECT_NEAR(found.T_odom_base.t().y(), 0.1, 2e-3);
}

TEST(Registration, WithoutMatchesThePoseIsTheStart) {
  Registered all = prepare(makeRoom(), Pose());
  const Pose far(Eigen::Quaterniond::Identity(), {500, 0, 0});
  const Registration found = registerPatches(all.patches, all.map, far, far, {});
  EXPECT_FALSE(found.solved);
  EXPECT_EQ(found.T_odom_base.matrix(), far.matrix());
}

}  // namespace
}  // namespace laser_odometry
