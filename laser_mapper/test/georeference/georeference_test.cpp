// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/georeference/georeference.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "laser_mapper/georeference/map_projection.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {
namespace {

using Eigen::Vector3d;
using urban_nav_core::LocalTangent;

constexpr double kRad = M_PI / 180.0;
const Geodetic kOxford{51.7548 * kRad, -1.2544 * kRad, 110.0};

TEST(MapProjection, AgreesWithPublishedCoordinates) {
  // Central meridian of zone 30: easting 500 km; the equator: northing 0; scale 0.9996 on the meridian.
  const MapProjection utm(32630, "--crs");
  const Vector3d middle = utm.project({0.0, -3.0 * kRad, 12.0});
  EXPECT_NEAR(middle.x(), 500000.0, 1e-3);
  EXPECT_NEAR(middle.y(), 0.0, 1e-3);
  EXPECT_EQ(middle.z(), 12.0);
  const double step = utm.project({1e-4 * kRad, -3.0 * kRad, 0.0}).y();
  EXPECT_NEAR(step, 0.9996 * 11.0574, 1e-3);
  EXPECT_NE(utm.wkt().find("PROJCS[\"WGS 84 / UTM zone 30N\""), std::string::npos);
  EXPECT_NE(utm.wkt().find("AUTHORITY[\"EPSG\",\"32630\"]"), std::string::npos);
}

TEST(MapProjection, RefusesWhatIsNoProjectionInMetres) {
  for (const int code : {4326, 4979, 2, 2230})  // geographic, geographic, unknown, feet
    EXPECT_THROW(MapProjection(code, "--crs"), urban_nav_core::UserError) << code;
}

TEST(MapProjection, FindsTheZone) {
  EXPECT_EQ(utmZoneCode(kOxford), 32630);
  EXPECT_EQ(utmZoneCode({-33.9 * kRad, 151.2 * kRad, 0.0}), 32756);
  EXPECT_EQ(utmZoneCode({10.0 * kRad, 180.0 * kRad, 0.0}) % 100, 60);
  EXPECT_EQ(utmZoneCode({10.0 * kRad, -180.0 * kRad, 0.0}) % 100, 1);
  EXPECT_EQ(utmZoneCode({88.0 * kRad, 0.0, 0.0}), 0);
}

/// Pose of a map on the earth, and fixes of a drive around a rectangle in it.
struct Drive {
  double yaw = 0.7;
  Vector3d shift{40.0, -25.0, 3.0};
  std::vector<AntennaFix> fixes;
};

/// `slow`, `white`: standard deviations of errors that last for 180 s, and of independent ones, m, horizontally.
Drive driveWithFixes(unsigned seed, double seconds, double slow, double white) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Drive drive;
  const LocalTangent tangent(kOxford);
  Vector3d drift(normal(random), normal(random), normal(random));
  const double keep = std::exp(-1.0 / 180.0);
  for (double t = 0.0; t < seconds; t += 1.0) {
    const double angle = 2.0 * M_PI * t / 150.0;
    AntennaFix fix;
    fix.stamp = 1'225'719'872'000'000'000 + static_cast<urban_nav_core::StampNs>(t * 1e9);
    fix.p_map = {45.0 * std::cos(angle), 30.0 * std::sin(angle), 1.5};
    drift = keep * drift + std::sqrt(1.0 - keep * keep) * Vector3d(normal(random), normal(random), normal(random));
    const Vector3d error = slow * drift + white * Vector3d(normal(random), normal(random), normal(random));
    const Vector3d local = Eigen::AngleAxisd(drive.yaw, Vector3d::UnitZ()) * fix.p_map + drive.shift;
    fix.measured = tangent.toGeodetic(local + Vector3d(error.x(), error.y(), 2.0 * error.z()));
    fix.sigma = std::max(0.01, std::hypot(slow, white)) * Vector3d(1.0, 1.0, 2.0);
    drive.fixes.push_back(fix);
  }
  return drive;
}

Vector3d errorOfFit(const Drive& drive, const GeoReference& reference) {
  const LocalTangent truth(kOxford), fitted(reference.origin);
  const Vector3d middle(0.0, 0.0, 1.5);
  return truth.toLocal(fitted.toGeodetic(reference.T_local_map * middle)) -
         (Eigen::AngleAxisd(drive.yaw, Vector3d::UnitZ()) * middle + drive.shift);
}

double headingError(const Drive& drive, const GeoReference& reference) {
  const Vector3d x = reference.T_local_map.q() * Vector3d::UnitX();
  return std::remainder(std::atan2(x.y(), x.x()) - drive.yaw, 2.0 * M_PI);
}

TEST(GeoFit, ExactFixesGiveTheExactPlace) {
  const Drive drive = driveWithFixes(1, 200.0, 0.0, 0.0);
  const GeoFit fit = fitGeoReference(drive.fixes);
  ASSERT_TRUE(fit.reference);
  EXPECT_LT(errorOfFit(drive, *fit.reference).norm(), 1e-3);
  EXPECT_NEAR(headingError(drive, *fit.reference), 0.0, 1e-5);
  EXPECT_LT(fit.reference->residual, 1e-3);
}

TEST(GeoFit, ErrorsAreThoseStated) {
  double position = 0.0, heading = 0.0, height = 0.0;
  constexpr unsigned kDrives = 60;
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    const Drive drive = driveWithFixes(seed, 400.0, 2.0, 0.7);
    const GeoFit fit = fitGeoReference(drive.fixes);
    ASSERT_TRUE(fit.reference);
    const Vector3d error = errorOfFit(drive, *fit.reference);
    position += error.head<2>().squaredNorm() / (2.0 * std::pow(fit.reference->position_sigma, 2)) / kDrives;
    height += std::pow(error.z() / fit.reference->height_sigma, 2) / kDrives;
    heading += std::pow(headingError(drive, *fit.reference) / fit.reference->heading_sigma, 2) / kDrives;
  }
  for (const double ratio : {position, height, heading}) {
    EXPECT_GT(ratio, 0.15) << "stated more than twice too large";
    EXPECT_LT(ratio, 1.5);
  }
}

TEST(GeoFit, ReflectionsDoNotMoveTheMap) {
  Drive drive = driveWithFixes(5, 200.0, 0.0, 0.3);
  const LocalTangent tangent(kOxford);
  for (std::size_t i = 60; i < 100; ++i)
    drive.fixes[i].measured = tangent.toGeodetic(tangent.toLocal(drive.fixes[i].measured) + Vector3d(35.0, 20.0, 0.0));
  const GeoFit fit = fitGeoReference(drive.fixes);
  ASSERT_TRUE(fit.reference);
  EXPECT_LT(errorOfFit(drive, *fit.reference).head<2>().norm(), 0.3);
  EXPECT_LT(std::abs(headingError(drive, *fit.reference)), 0.5 * kRad);
}

TEST(GeoFit, StatesWhyThereIsNoPlace) {
  EXPECT_NE(fitGeoReference({}).reason.find("0 GPS fixes"), std::string::npos);
  Drive standing = driveWithFixes(1, 100.0, 2.0, 0.5);
  for (AntennaFix& fix : standing.fixes) fix.p_map = {1.0, 2.0, 1.5};
  const GeoFit fit = fitGeoReference(standing.fixes);
  EXPECT_FALSE(fit.reference);
  EXPECT_NE(fit.reason.find("the path is too short"), std::string::npos) << fit.reason;
}

TEST(GeoFit, WorksAcrossTheDateLine) {
  const Geodetic fiji{-17.0 * kRad, M_PI, 0.0};
  const LocalTangent tangent(fiji);
  std::vector<AntennaFix> fixes;
  for (int i = 0; i < 100; ++i) {
    AntennaFix fix;
    fix.stamp = i * 1'000'000'000LL;
    fix.p_map = {2.0 * i - 100.0, 40.0 * std::sin(0.1 * i), 0.0};
    fix.measured = tangent.toGeodetic(fix.p_map);
    fix.measured.longitude = std::remainder(fix.measured.longitude, 2.0 * M_PI);
    fixes.push_back(fix);
  }
  const GeoFit fit = fitGeoReference(fixes);
  ASSERT_TRUE(fit.reference);
  EXPECT_LT(fit.reference->residual, 1e-2);
}

}  // namespace
}  // namespace laser_mapper
