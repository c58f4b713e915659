// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/camera_info.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <limits>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

StereoCamera infoCamera() { return {{389.5, 391.25, 254.75, 201.5, 512, 384}, 0.12}; }

TEST(CameraInfo, OfARectifiedPairGivesThePairBack) {
  const StereoCamera back = stereoCamera(leftInfo(infoCamera()), rightInfo(infoCamera()), "here");
  EXPECT_TRUE(isApprox(back, infoCamera(), 1e-12)) << back;
  EXPECT_FALSE(needsRectification(leftInfo(infoCamera())));
  EXPECT_FALSE(needsRectification(rightInfo(infoCamera())));
  EXPECT_TRUE(isApprox(rawCamera(leftInfo(infoCamera()), "here").pinhole, infoCamera().left, 0.0));
}

TEST(CameraInfo, ReportsWhetherARemapIsNeeded) {
  CameraInfo info = leftInfo(infoCamera());
  info.D[0] = -0.1;
  EXPECT_TRUE(needsRectification(info));
  info = leftInfo(infoCamera());
  info.K(0, 2) += 1.0;
  EXPECT_TRUE(needsRectification(info));
  info = leftInfo(infoCamera());
  info.R = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(needsRectification(info));
  info.R.setZero();
  EXPECT_FALSE(needsRectification(info));
}

std::string errorAfter(const std::function<void(CameraInfo&, CameraInfo&)>& spoil) {
  CameraInfo left = leftInfo(infoCamera()), right = rightInfo(infoCamera());
  spoil(left, right);
  try {
    stereoCamera(left, right, "calib.yaml");
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(CameraInfo, PairsThatDoNotBelongTogetherAreRefusedInWords) {
  EXPECT_NE(errorAfter([](auto& left, auto& right) { std::swap(left, right); }).find("swapped"), std::string::npos);
  EXPECT_NE(errorAfter([](auto&, auto& right) { right.P(1, 2) += 0.5; }).find("cy of the left camera"),
            std::string::npos);
  EXPECT_NE(errorAfter([](auto&, auto& right) { right.P(0, 0) += 1.0; }).find("fx of the left camera"),
            std::string::npos);
  EXPECT_NE(errorAfter([](auto&, auto& right) { right.width = 640; }).find("equal sizes"), std::string::npos);
  EXPECT_NE(errorAfter([](auto& left, auto&) { left.P.setZero(); }).find("focal lengths above zero"),
            std::string::npos);
  EXPECT_NE(errorAfter([](auto& left, auto&) { left.height = 0; }).find("image size 512x0"), std::string::npos);
  EXPECT_NE(errorAfter([](auto&, auto& right) { right.P(0, 3) = std::numeric_limits<double>::quiet_NaN(); }), "");
  EXPECT_EQ(errorAfter([](auto&, auto& right) { right.P(1, 2) += 0.005; }), "");
}

}  // namespace
}  // namespace urban_nav_core
