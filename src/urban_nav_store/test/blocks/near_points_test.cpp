// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/tables/near_points.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {
namespace {

NearPoints pointsOfKeyframe(const std::vector<NearPoints::Point>& points) {
  NearPoints row;
  row.camera = {0.3, 0.0, 1.0};
  row.pixel_angle = 0.0025;
  row.packed = NearPoints::pack(points);
  return row;
}

TEST(NearPoints, ComeBackToAQuarterOfAMillimetre) {
  const std::vector<NearPoints::Point> points = {{{4.1234F, -2.5F, 0.0001F}, 0.0123F, 200},
                                                 {{-8.1F, 8.1F, 0.0F}, 0.5F, 0}};
  const std::vector<NearPoints::Point> back = pointsOfKeyframe(points).points();
  ASSERT_EQ(back.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((back[i].p_base - points[i].p_base).cwiseAbs().maxCoeff(), 0.000126F);
    EXPECT_NEAR(back[i].sigma, points[i].sigma, 5.1e-5F);
    EXPECT_EQ(back[i].grey, points[i].grey);
  }
}

TEST(NearPoints, LeaveOutWhatCannotBeEncoded) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(NearPoints::pack({{{nan, 0.0F, 0.0F}, 0.1F, 1}}).empty());
  EXPECT_TRUE(NearPoints::pack({{{0.0F, infinity, 0.0F}, 0.1F, 1}}).empty());
  EXPECT_TRUE(NearPoints::pack({{{0.0F, 9.0F, 0.0F}, 0.1F, 1}}).empty());
  EXPECT_TRUE(NearPoints::pack({{{0.0F, 1.0F, 0.0F}, nan, 1}}).empty());
  const std::vector<NearPoints::Point> back = pointsOfKeyframe({{{0.0F, 1.0F, 0.0F}, 100.0F, 1}}).points();
  ASSERT_EQ(back.size(), 1U);
  EXPECT_NEAR(back[0].sigma, 6.5535F, 1e-4F) << "the largest one";
}

TEST(NearPoints, RefuseBytesOfAnotherLength) {
  NearPoints row = pointsOfKeyframe({{{1.0F, 1.0F, 1.0F}, 0.1F, 1}});
  row.packed.pop_back();
  EXPECT_THROW(row.points(), urban_nav_core::DataError);
}

TEST(NearPoints, HaveTheLargestErrorAlongTheRay) {
  const NearPoints row = pointsOfKeyframe({});
  const NearPoints::Point point{{4.3F, 0.0F, 1.0F}, 0.1F, 0};  // straight ahead of the camera, 4 m away
  const Eigen::Matrix3d covariance = row.covariance(point);
  EXPECT_NEAR(covariance(0, 0), 0.01, 1e-8);
  EXPECT_NEAR(covariance(1, 1), 0.0001 / 12.0, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 0.0001 / 12.0, 1e-9);
  EXPECT_NEAR(covariance(0, 1), 0.0, 1e-8);
}

}  // namespace
}  // namespace urban_nav_store
