// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/georeference/control_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "laser_mapper/georeference/map_projection.hpp"

namespace laser_mapper {
namespace {

using Eigen::Vector3d;

constexpr double kYaw = 0.7;
const Vector3d kShift{12.0, -7.0, 3.0};
const Geodetic kChurch{51.7548 * M_PI / 180.0, -1.2544 * M_PI / 180.0, 110.0};

/// Points of a map that is turned by kYaw and shifted by kShift from axes east, north, up.
std::vector<ControlPoint> surveyedCorners() {
  const urban_nav_core::LocalTangent tangent(kChurch);
  const Eigen::AngleAxisd turn(kYaw, Vector3d::UnitZ());
  std::vector<ControlPoint> points;
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(50, 0, 1), Vector3d(50, 30, 0), Vector3d(0, 30, -1)})
    points.push_back({"corner " + std::to_string(points.size()), tangent.toGeodetic(turn * p + kShift), p});
  return points;
}

/// Returns the largest distance of the points from their surveyed positions after the fit.
double largestError(const GeoReference& reference, const std::vector<ControlPoint>& points) {
  const urban_nav_core::LocalTangent tangent(reference.origin);
  double largest = 0.0;
  for (const ControlPoint& point : points)
    largest = std::max(largest, (reference.T_local_map * point.p_map - tangent.toLocal(point.surveyed)).norm());
  return largest;
}

TEST(ControlPoints, ExactPointsAreMetExactly) {
  const std::vector<ControlPoint> points = surveyedCorners();
  for (const std::size_t count : {2U, 3U, 4U}) {
    const std::vector<ControlPoint> some(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count));
    const ControlFit fit = fitControlPoints(some);
    ASSERT_TRUE(fit.fit.reference) << fit.fit.reason;
    EXPECT_LT(largestError(*fit.fit.reference, points), 1e-3) << "also of points that were not used";
    EXPECT_EQ(fit.fit.reference->fixes, count);
    EXPECT_LT(fit.fit.reference->heading_sigma, 1e-4);
    EXPECT_EQ(fit.errors.size(), count);
  }
}

TEST(ControlPoints, ErrorsAndUncertaintyAreThoseOfTheResiduals) {
  std::vector<ControlPoint> points = surveyedCorners();
  points[1].p_map.x() += 0.2;
  const ControlFit fit = fitControlPoints(points);
  ASSERT_TRUE(fit.fit.reference);
  EXPECT_GT(fit.errors[1], 0.05);
  EXPECT_LT(fit.errors[1], 0.2);
  EXPECT_GT(fit.fit.reference->position_sigma, 0.02);
  EXPECT_LT(fit.fit.reference->position_sigma, 0.2);
}

TEST(ControlPoints, RefusesWhatDoesNotPlaceTheMap) {
  std::vector<ControlPoint> points = surveyedCorners();
  EXPECT_NE(fitControlPoints({points[0]}).fit.reason.find("1 surveyed points, 2 are needed"), std::string::npos);
  EXPECT_NE(fitControlPoints({points[0], points[0]}).fit.reason.find("heading"), std::string::npos);
  std::swap(points[0].surveyed, points[1].surveyed);
  const ControlFit exchanged = fitControlPoints(points);
  EXPECT_FALSE(exchanged.fit.reference);
  EXPECT_NE(exchanged.fit.reason.find("another shape than the surveyed points: corner"), std::string::npos)
      << exchanged.fit.reason;
}

TEST(ControlPoints, ProjectedCoordinatesAreTurnedBack) {
  const MapProjection utm(32630, "--crs");
  const Geodetic back = utm.unproject(utm.project(kChurch));
  EXPECT_NEAR(back.latitude, kChurch.latitude, 1e-11);
  EXPECT_NEAR(back.longitude, kChurch.longitude, 1e-11);
  EXPECT_EQ(back.height, kChurch.height);
  EXPECT_NE(utm.esriWkt().find("WGS_1984_UTM_Zone_30N"), std::string::npos);
}

}  // namespace
}  // namespace laser_mapper
