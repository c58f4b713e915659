// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/pose_with_covariance.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_core {
namespace {

const Pose kPose(expSo3({0.0, 0.0, 0.5}), {1.0, 2.0, 3.0});

TEST(PoseWithCovariance, ComparesPoseAndCovariance) {
  const PoseWithCovariance a{kPose, Matrix6d::Identity()};
  PoseWithCovariance b = a;
  EXPECT_TRUE(isApprox(a, b, 0.0));
  b.covariance(2, 5) += 1e-3;
  EXPECT_FALSE(isApprox(a, b, 0.9e-3));
  EXPECT_TRUE(isApprox(a, b, 1.1e-3));
  b = {boxPlus(kPose, Vector6d::Unit(4) * 1e-3), a.covariance};
  EXPECT_FALSE(isApprox(a, b, 0.9e-3));
  b = a;
  b.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isApprox(a, b, 1e9));
}

TEST(RelativePose, ComparesStampsStatusAndSource) {
  const RelativePose a{1, 2, kPose, Matrix6d::Identity(), Matrix6d::Zero(), {}, "swf_vo"};
  RelativePose b = a;
  EXPECT_TRUE(isApprox(a, b, 0.0));
  b.to = 3;
  EXPECT_FALSE(isApprox(a, b, 1.0));
  b = a;
  b.source = "wheels";
  EXPECT_FALSE(isApprox(a, b, 1.0));
  b = a;
  b.status.health = Health::Lost;
  EXPECT_FALSE(isApprox(a, b, 1.0));
}

TEST(Constraint, ComparesInformation) {
  Constraint a{kPose, Matrix6d::Zero()};
  const Constraint b = a;
  a.information(3, 3) = 1.0;
  EXPECT_FALSE(isApprox(a, b, 0.5));
  EXPECT_TRUE(isApprox(a, b, 1.0));
}

TEST(Uncertain, PrintsThemselves) {
  std::ostringstream out;
  out << PoseWithCovariance{kPose, Matrix6d::Identity() * 4.0};
  EXPECT_EQ(out.str(), "t = (1, 2, 3) m, rotation vector = (0, 0, 0.5) rad, sigma = (2, 2, 2) m, (2, 2, 2) rad");
  out.str("");
  out << RelativePose{0, 1000000000, Pose(), Matrix6d::Identity(), Matrix6d::Zero(), {}, "swf_vo"};
  EXPECT_EQ(
      out.str(),
      "0.000000000 -> 1.000000000 s: t = (0, 0, 0) m, rotation vector = (0, 0, 0) rad, sigma = (1, 1, 1) m, (1, 1, 1) "
      "rad, OK, from swf_vo");
  out.str("");
  out << MotionInput{0, 1, Pose(), Matrix6d::Identity()} << Constraint{};
  EXPECT_NE(out.str().find("information diagonal = (1 1 1 1 1 1)"), std::string::npos);
  EXPECT_NE(out.str().find("information diagonal = (0 0 0 0 0 0)"), std::string::npos);
}

TEST(MotionInput, ChoiceOfSensorsIsThatOfTheParameter) {
  const auto isChoice = [](const char* text, bool gyroscope, bool wheels, bool is_required) {
    const MotionChoice choice = toMotionChoice(text);
    return choice.gyroscope == gyroscope && choice.wheels == wheels && choice.is_required == is_required;
  };
  EXPECT_TRUE(isChoice("auto", true, true, false));
  EXPECT_TRUE(isChoice("none", false, false, false));
  EXPECT_TRUE(isChoice("gyroscope", true, false, true));
  EXPECT_TRUE(isChoice("wheels", false, true, true));
}

TEST(MotionInput, Compares) {
  const MotionInput a{0, 1, kPose, Matrix6d::Zero()};
  MotionInput b = a;
  EXPECT_TRUE(isApprox(a, b, 0.0));
  b.information(0, 0) = 1.0;
  EXPECT_FALSE(isApprox(a, b, 0.5));
  b = a;
  b.source = MotionSource::Wheels;
  EXPECT_FALSE(isApprox(a, b, 0.5));
}

}  // namespace
}  // namespace urban_nav_core
