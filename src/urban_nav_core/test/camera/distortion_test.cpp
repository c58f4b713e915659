// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/distortion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

// The left camera of EuRoC's V1_01, and a rational model like those of wide lenses.
const Distortion kPlumbBob({-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0, 0.0, 0.0, 0.0});
const Distortion kRational({0.45, -0.11, 0.0003, -0.0002, 0.013, 0.80, 0.05, 0.002});
// The left camera of TUM-VI.
const Distortion kFisheye = Distortion::equidistant({0.0034, 0.00077, -0.00076, 0.00026});
const Distortion kFolding({-0.35, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});

TEST(Distortion, UndistortInvertsDistort) {
  for (const Distortion& lens : {kPlumbBob, kRational, kFisheye, Distortion()}) {
    for (double x = -1.0; x <= 1.0; x += 0.1) {
      for (double y = -0.7; y <= 0.7; y += 0.1) {
        const auto seen = lens.distort({x, y});
        ASSERT_TRUE(seen) << x << ", " << y << ": " << lens;
        const auto back = lens.undistort(*seen);
        ASSERT_TRUE(back) << x << ", " << y << ": " << lens;
        EXPECT_NEAR(back->x(), x, 1e-10);
        EXPECT_NEAR(back->y(), y, 1e-10);
      }
    }
  }
}

TEST(Distortion, JacobianIsTheNumericDerivative) {
  for (const Distortion& lens : {kPlumbBob, kRational, kFisheye}) {
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.7, -0.4), Eigen::Vector2d(-1.1, 0.8)}) {
      const double h = 1e-6;
      Eigen::Matrix2d numeric;
      numeric.col(0) = (*lens.distort(p + Eigen::Vector2d(h, 0)) - *lens.distort(p - Eigen::Vector2d(h, 0))) / (2 * h);
      numeric.col(1) = (*lens.distort(p + Eigen::Vector2d(0, h)) - *lens.distort(p - Eigen::Vector2d(0, h))) / (2 * h);
      EXPECT_LT((numeric - lens.jacobian(p)).norm(), 1e-8) << lens;
    }
  }
}

TEST(Distortion, RefusesWhereItFolds) {
  // r (1 - 0.35 r^2) turns back at r = 1 / sqrt(3 * 0.35), where it is 2/3 of that.
  const double fold = 1.0 / std::sqrt(3.0 * 0.35);
  EXPECT_NEAR(kFolding.foldRadius(), fold, 1e-9);
  EXPECT_TRUE(kFolding.distort({0.99 * fold, 0.0}));
  EXPECT_FALSE(kFolding.distort({1.01 * fold, 0.0}));
  EXPECT_FALSE(kFolding.distort({0.0, 5.0}));
  const double most = fold * 2.0 / 3.0;
  const auto near = kFolding.undistort({0.0, 0.999 * most});
  ASSERT_TRUE(near);
  EXPECT_LT(near->y(), fold);
  EXPECT_FALSE(kFolding.undistort({0.0, 1.001 * most}));
  EXPECT_FALSE(kFolding.undistort({std::nan(""), 0.0}));
  EXPECT_EQ(kPlumbBob.foldRadius(), Distortion::kLargestRadius);
}

TEST(Distortion, EndsWhereTheDenominatorDoes) {
  const Distortion lens({0.0, 0.0, 0.0, 0.0, 0.0, -0.25, 0.0, 0.0});  // 1 / (1 - r^2 / 4): infinite at r = 2
  EXPECT_LE(lens.foldRadius(), 2.0);
  EXPECT_FALSE(lens.distort({2.5, 0.0}));
  const auto far = lens.undistort({1e3, 0.0});
  ASSERT_TRUE(far);
  EXPECT_NEAR(lens.distort(*far)->x(), 1e3, 1e-6);
}

TEST(Distortion, IsNamedAsInCameraInfoAndEuroc) {
  EXPECT_EQ(
      Distortion::named("radial-tangential", {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}, "f").coefficients(),
      kPlumbBob.coefficients());
  EXPECT_EQ(Distortion::named("rational_polynomial", {0.45, -0.11, 0.0003, -0.0002, 0.013, 0.80, 0.05, 0.002}, "f")
                .coefficients(),
            kRational.coefficients());
  EXPECT_TRUE(Distortion::named("", {}, "f").isNone());
  EXPECT_TRUE(Distortion::named("equidistant", {0.0, 0.0, 0.0, 0.0}, "f").isNone());
}

TEST(Distortion, FisheyeBendsAnglesNotSlopes) {
  const Distortion lens = Distortion::equidistant({1e-12, 0.0, 0.0, 0.0});
  for (const double angle : {0.01, 0.5, 1.2, 1.4}) {
    const auto seen = lens.distort({0.6 * std::tan(angle), 0.8 * std::tan(angle)});
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->norm(), angle, 1e-9);
    EXPECT_NEAR(seen->x() / seen->y(), 0.75, 1e-9);
  }
}

TEST(Distortion, CoefficientsMayBePaddedWithZeros) {
  const auto& k = kPlumbBob.coefficients();
  const std::vector<double> four(k.begin(), k.begin() + 4);
  for (const std::size_t n : {4, 5, 8, 12, 14}) {
    std::vector<double> padded = four;
    padded.resize(n, 0.0);
    EXPECT_EQ(Distortion::named("plumb_bob", padded, "f").coefficients(), k);
    EXPECT_EQ(Distortion::named("rational_polynomial", padded, "f").coefficients(), k);
  }
  EXPECT_THROW(Distortion::named("rational_polynomial", {0.1, 0, 0, 0, 0, 0, 0, 0, 1e-3}, "f"), UserError);
}

TEST(Distortion, MistakesAreNamed) {
  EXPECT_THROW(Distortion::named("plumb_bob", {0.1, 0.2}, "left.yaml"), UserError);
  EXPECT_THROW(Distortion::named("equidistant", {0.1, 0.2, 0.0, 0.0, 0.3}, "left.yaml"), UserError);
  EXPECT_THROW(Distortion::named("plumb_bob", {0.1, std::nan(""), 0.0, 0.0}, "left.yaml"), UserError);
  try {
    Distortion::named("omni", {0.1, 0.2, 0.0, 0.0}, "left.yaml");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("left.yaml: distortion model omni"), std::string::npos) << error.what();
  }
}

TEST(Distortion, Prints) {
  std::ostringstream text;
  text << Distortion() << "; " << kFolding;
  EXPECT_EQ(text.str(), "no distortion; k1 = -0.35, k2 = 0, p1 = 0, p2 = 0, k3 = 0");
}

TEST(Distortion, AnEmptyNameIsThatOfTheNumberOfCoefficients) {
  const std::vector<double> five = {-0.2, 0.1, 0.001, 0.002, 0.03},
                            eight = {-0.2, 0.1, 0.001, 0.002, 0.03, 0.1, 0.2, 0.3};
  const Eigen::Vector2d p(0.3, -0.2);
  for (const auto& [coefficients, name] :
       {std::make_pair(five, "plumb_bob"), std::make_pair(eight, "rational_polynomial")}) {
    const Distortion unnamed = Distortion::named("", coefficients, "c"),
                     named = Distortion::named(name, coefficients, "c");
    EXPECT_EQ(unnamed.distort(p).value(), named.distort(p).value()) << name;
  }
  try {
    (void)Distortion::named("", {-0.2, 0.1, 0.001, 0.002}, "left.yaml");  // plumb_bob or a fisheye
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("distortion_model is empty"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace urban_nav_core
