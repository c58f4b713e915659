// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/ground_finding.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::Vector3d;

namespace {

constexpr std::size_t kFewGrounds = 5;
constexpr double kScattered = 4.0;  // deg, median deviation of the normals
constexpr double kAgree = 8.0;      // deg
constexpr double kTilted = 15.0;    // deg: the mean slope of a drive is below 27 %

double degreesBetween(const Vector3d& a, const Vector3d& b) {
  return 180.0 / M_PI * std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<Finding> groundFindings(const std::string& imu, const std::vector<SeenGround>& grounds,
                                    const Vector3d& force) {
  if (grounds.size() < kFewGrounds || !(force.norm() > 0.0)) return {};
  std::vector<double> x, y, z, deviations;
  for (const SeenGround& each : grounds) x.push_back(each.up.x()), y.push_back(each.up.y()), z.push_back(each.up.z());
  const auto median = [](const std::vector<double>& values) { return urban_nav_core::quantile(values, 0.5); };
  const Vector3d ground = Vector3d(median(x), median(y), median(z)).normalized();
  for (const SeenGround& each : grounds) deviations.push_back(degreesBetween(each.up, ground));
  if (median(deviations) > kScattered) return {};
  const double ground_base = degreesBetween(ground, Vector3d::UnitZ()),
               force_base = degreesBetween(force, Vector3d::UnitZ()), both = degreesBetween(ground, force);
  const std::string transform =
      "--transform PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW sets its pose; correct /tf_static for later recordings";
  if (force_base > kTilted && ground_base < kAgree)
    return {{FindingKind::Imu,
             imu + ": the accelerometer measures up " + formatNumber(force_base, 3) +
                 " deg from the z axis of base_link, and the ground measured by stereo is level with base_link to " +
                 formatNumber(ground_base, 3) + " deg: the pose of the IMU in tf or its axes are wrong",
             transform}};
  if (ground_base > kTilted && force_base < kAgree && both > kTilted)
    return {{FindingKind::Tf,
             "the ground measured by stereo is inclined by " + formatNumber(ground_base, 3) +
                 " deg to base_link, and gravity is vertical in base_link to " + formatNumber(force_base, 3) +
                 " deg: the pose of the camera in tf is wrong",
             transform}};
  return {};
}

}  // namespace urban_nav_input
