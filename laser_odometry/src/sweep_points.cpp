// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_points.hpp"

#include <algorithm>
#include <cmath>

namespace laser_odometry {
namespace {

// Number of poses between which the motion is linear: the error for a rotation of a is (a / 256)^2 / 8.
constexpr int kKnots = 256;

}  // namespace

void SweepPoints::archive(urban_nav_core::Archive& archive) {
  archive(p, time, first_s, last_s, valid, near);
  archive.require(p.size() == time.size(), "points without times");
}

SweepPoints collectPoints(const urban_nav_core::Sweep& sweep, const Pose& T_base_lidar, double min_range,
                          double max_range, double longest_s) {
  SweepPoints points;
  points.p.reserve(sweep.beams.size());
  points.time.reserve(sweep.beams.size());
  const Eigen::Matrix3f R = T_base_lidar.R().cast<float>();
  const Eigen::Vector3f t = T_base_lidar.t().cast<float>();
  const bool is_timed = sweep.times == urban_nav_core::Sweep::Times::Measured;
  for (const urban_nav_core::Beam& beam : sweep.beams) {
    const Eigen::Vector3f p = beam.range * beam.direction;
    if (!p.allFinite() || !(beam.range > 0.0F)) continue;
    ++points.valid;
    if (static_cast<double>(beam.range) < min_range) {
      ++points.near;
      continue;
    }
    if (static_cast<double>(beam.range) > max_range) continue;
    const double time = is_timed ? urban_nav_core::secondsBetween(sweep.reference, beam.stamp) : 0.0;
    if (!(std::abs(time) <= longest_s)) continue;
    points.p.push_back(R * p + t);
    points.time.push_back(static_cast<float>(time));
    points.first_s = std::min(points.first_s, time);
    points.last_s = std::max(points.last_s, time);
  }
  return points;
}

std::vector<Vector3d> deskew(const SweepPoints& points, const SweepMotion& motion) {
  std::vector<Vector3d> moved;
  moved.reserve(points.p.size());
  const double span = points.last_s - points.first_s;
  if (!(span > 0.0)) {
    for (const Eigen::Vector3f& p : points.p) moved.push_back(p.cast<double>());
    return moved;
  }
  struct Knot {
    Matrix3d R;
    Vector3d t;
  };
  std::vector<Knot> knots;
  knots.reserve(kKnots + 2);
  for (int i = 0; i <= kKnots + 1; ++i) {
    const double t = points.first_s + span * i / kKnots;
    const Pose T = urban_nav_core::expSe3(t * motion.twist + 0.5 * t * t * motion.acceleration);
    knots.push_back({T.R(), T.t()});
  }
  const double per_s = kKnots / span;
  for (std::size_t i = 0; i < points.p.size(); ++i) {
    const double at = std::max(0.0, (static_cast<double>(points.time[i]) - points.first_s) * per_s);
    const int before = std::min(static_cast<int>(at), kKnots);
    const double share = at - before;
    const Knot& a = knots[static_cast<std::size_t>(before)];
    const Knot& b = knots[static_cast<std::size_t>(before) + 1];
    const Vector3d p = points.p[i].cast<double>();
    moved.push_back((1.0 - share) * (a.R * p + a.t) + share * (b.R * p + b.t));
  }
  return moved;
}

}  // namespace laser_odometry
