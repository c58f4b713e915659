// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_points.hpp"

#include <algorithm>
#include <cmath>

namespace laser_odometry {
namespace {

// Number of poses between which the motion is linear: the error for a rotation of a is (a / 256)^2 / 8.
constexpr int kKnots = 256;
constexpr std::uint32_t kNone = 0xffffffff;

/// Sums of a segment, relative to its first return.
struct Sums {
  Eigen::Vector3f first = Eigen::Vector3f::Zero(), last = Eigen::Vector3f::Zero();
  Moments moments;
  double time = 0.0, half_square = 0.0;
  std::int32_t ring = 0;

  void add(const Eigen::Vector3f& p, double at) {
    last = p;
    moments.add((p - first).cast<double>());
    time += at;
    half_square += 0.5 * at * at;
  }
};

bool hasRings(const urban_nav_core::Sweep& sweep) {
  return std::any_of(sweep.beams.begin(), sweep.beams.end(),
                     [&](const urban_nav_core::Beam& beam) { return beam.ring != sweep.beams.front().ring; });
}

/// Divides returns into segments.
class Segmentation {
 public:
  Segmentation(double length, std::size_t beams) : square_(static_cast<float>(length * length)) {
    sums_.reserve(beams / 4 + 64);
  }

  void add(std::int32_t ring, const Eigen::Vector3f& p, double time) {
    if (ring == Segment::kUnknownRing) {
      sums_.push_back({p, p, {}, 0.0, 0.0, ring});
      sums_.back().add(p, time);
      return;
    }
    const auto number = static_cast<std::size_t>(ring);
    if (number >= open_.size()) open_.resize(number + 1, kNone);
    std::uint32_t& open = open_[number];
    if (open == kNone || (p - sums_[open].last).squaredNorm() > square_ ||
        (p - sums_[open].first).squaredNorm() > square_) {
      open = static_cast<std::uint32_t>(sums_.size());
      sums_.push_back({p, p, {}, 0.0, 0.0, ring});
    }
    sums_[open].add(p, time);
  }

  std::vector<Segment> segments() const {
    std::vector<Segment> segments;
    segments.reserve(sums_.size());
    for (const Sums& sums : sums_) {
      const double n = sums.moments.count;
      const Matrix3d covariance = n > 1.0 ? sums.moments.covariance() : Matrix3d(Matrix3d::Zero());
      segments.push_back({sums.first.cast<double>() + sums.moments.mean(), covariance, n, sums.time / n,
                          sums.half_square / n, sums.ring});
    }
    return segments;
  }

 private:
  float square_;                     // m^2
  std::vector<std::uint32_t> open_;  // number of the open segment by ring
  std::vector<Sums> sums_;
};

}  // namespace

void SweepPoints::archive(urban_nav_core::Archive& archive) {
  archive(segments, first_s, last_s, used, valid, near);
  for (const Segment& segment : segments) archive.require(segment.count > 0.0, "segment without returns");
}

SweepPoints collectPoints(const urban_nav_core::Sweep& sweep, const Pose& T_base_lidar, const PointsRule& rule) {
  SweepPoints points;
  Segmentation segmentation(rule.length, sweep.beams.size());
  const bool is_planar = rule.space == MotionSpace::Planar;
  Eigen::Matrix3f R = T_base_lidar.R().cast<float>();
  Eigen::Vector3f t = T_base_lidar.t().cast<float>();
  if (is_planar) {
    R.row(2).setZero();
    t.z() = 0.0F;
  }
  const bool has_rings = is_planar || hasRings(sweep);
  const bool is_timed = sweep.times == urban_nav_core::Sweep::Times::Measured;
  for (const urban_nav_core::Beam& beam : sweep.beams) {
    const Eigen::Vector3f p = beam.range * beam.direction;
    if (!p.allFinite() || !(beam.range > 0.0F)) continue;
    ++points.valid;
    if (static_cast<double>(beam.range) < rule.min_range) {
      ++points.near;
      continue;
    }
    if (static_cast<double>(beam.range) > rule.max_range) continue;
    const double time = is_timed ? urban_nav_core::secondsBetween(sweep.reference, beam.stamp) : 0.0;
    if (!(std::abs(time) <= rule.longest_s)) continue;
    segmentation.add(has_rings ? beam.ring : Segment::kUnknownRing, R * p + t, time);
    ++points.used;
    points.first_s = std::min(points.first_s, time);
    points.last_s = std::max(points.last_s, time);
  }
  points.segments = segmentation.segments();
  return points;
}

std::vector<Segment> deskew(const SweepPoints& points, const SweepMotion& motion) {
  std::vector<Segment> moved = points.segments;
  const double span = points.last_s - points.first_s;
  if (!(span > 0.0)) return moved;
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
  for (Segment& segment : moved) {
    const double at = std::max(0.0, (segment.time - points.first_s) * per_s);
    const int before = std::min(static_cast<int>(at), kKnots);
    const double share = at - before;
    const Knot& a = knots[static_cast<std::size_t>(before)];
    const Knot& b = knots[static_cast<std::size_t>(before) + 1];
    segment.mean = (1.0 - share) * (a.R * segment.mean + a.t) + share * (b.R * segment.mean + b.t);
    segment.covariance = a.R * segment.covariance * a.R.transpose();
  }
  return moved;
}

std::vector<Segment> transformed(const Pose& T, std::vector<Segment> segments) {
  const Matrix3d R = T.R();
  const Vector3d t = T.t();
  for (Segment& segment : segments) {
    segment.mean = R * segment.mean + t;
    segment.covariance = R * segment.covariance * R.transpose();
  }
  return segments;
}

}  // namespace laser_odometry
