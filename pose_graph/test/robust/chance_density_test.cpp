// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/chance_density.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/drawn.hpp"

namespace pose_graph {
namespace {

// Uniform over a square of 20 m and all headings: the density is 1 / (400 2 pi).
TEST(ChanceDensity, OfAnEvenSpreadIsOneOverItsVolume) {
  test::Dice dice(3);
  std::vector<Rigid<2>> poses;
  for (int i = 0; i < 20000; ++i)
    poses.push_back({expRotation(RotationVector<2>(dice.uniform(-M_PI, M_PI))),
                     Eigen::Vector2d(dice.uniform(-10.0, 10.0), dice.uniform(-10.0, 10.0))});
  const PoseSample<2> sample(poses, 10.0);
  for (const double x : {-5.0, 0.0, 5.0})
    EXPECT_NEAR(sample.logDensity({expRotation(RotationVector<2>(0.3 * x)), Eigen::Vector2d(x, 1.0)}),
                -std::log(400.0 * 2.0 * M_PI), std::log(2.0));
}

TEST(ChanceDensity, OfASpreadInSpaceIsOneOverItsVolume) {
  test::Dice dice(4);
  std::vector<Rigid<3>> poses;
  const double width = 1.0;  // of each coordinate of the rotation vector
  for (int i = 0; i < 50000; ++i) {
    const auto draw = [&](double half) {
      return Eigen::Vector3d(dice.uniform(-half, half), dice.uniform(-half, half), dice.uniform(-half, half));
    };
    poses.push_back({expRotation(RotationVector<3>(draw(0.5 * width))), draw(10.0)});
  }
  // Near the edge of the distribution the nearest samples are on one side only: a factor of two in the sixth dimension.
  EXPECT_NEAR(PoseSample<3>(poses, 10.0).logDensity({}), -std::log(8000.0 * width * width * width), std::log(2.5));
}

// The excluded pair occurs a thousand times: only the other samples count as chance.
TEST(ChanceDensity, OfTheOwnPairIsWithoutIt) {
  test::Dice dice(5);
  std::vector<Rigid<2>> poses;
  std::vector<std::pair<int, int>> ends;
  for (int i = 0; i < 2000; ++i) {
    const bool own = i % 2 == 1;
    poses.push_back(
        {expRotation(RotationVector<2>(own ? 0.0 : dice.uniform(-M_PI, M_PI))),
         own ? Eigen::Vector2d(2.0, 0.0) : Eigen::Vector2d(dice.uniform(-10.0, 10.0), dice.uniform(-10.0, 10.0))});
    ends.emplace_back(own ? 50 + i % 5 : 200 + i, own ? 90 - i % 5 : 5000 + i);
  }
  const PoseSample<2> sample(poses, 10.0, ends);
  const Rigid<2> at{Eigen::Matrix2d::Identity(), Eigen::Vector2d(2.0, 0.0)};
  EXPECT_NEAR(sample.logDensity(at, 0.0, {52, 88, 5}), -std::log(400.0 * 2.0 * M_PI), std::log(2.0));
  EXPECT_GT(sample.logDensity(at, 0.0, {500, 88, 5}), 0.0);
}

TEST(ChanceDensity, FarFromEverySampleIsNotZero) {
  const std::vector<Rigid<2>> poses(100);
  const double far = PoseSample<2>(poses, 5.0).logDensity({Eigen::Matrix2d::Identity(), Eigen::Vector2d(1e4, 0.0)});
  EXPECT_TRUE(std::isfinite(far));
  EXPECT_LT(far, PoseSample<2>(poses, 5.0).logDensity({}));
  EXPECT_TRUE(std::isfinite(PoseSample<2>({}, 5.0).logDensity({})));
}

}  // namespace
}  // namespace pose_graph
