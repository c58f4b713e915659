// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/ground_plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace dense_stereo {

using urban_nav_core::StereoCamera;

namespace {

constexpr std::size_t kLeastPoints = 200;
constexpr int kSamples = 300;
constexpr std::size_t kScoredPoints = 1500;
constexpr double kLeastSupport = 0.1;      // of all points within range: a strip of ground between obstacles
constexpr double kGroundBand = 0.3;        // m, above and below the plane: candidates for ground
constexpr double kLeastPlanarShare = 0.8;  // of the area in that band
constexpr int kPlanCells = 128;            // along each side of the top view, over twice the range
constexpr std::uint8_t kOnPlane = 1, kInBand = 2;
constexpr double kDegrees = M_PI / 180.0;
constexpr double kPointsOfAWindow = 80.0;  // points with correlated disparities
constexpr double kFarMargin = 1.1;
constexpr int kFitSteps = 5;

/// Plane d = a u + b v + c, with u and v relative to the principal point; equivalent to a plane in space.
using DisparityPlane = Eigen::Vector3d;

struct SpacePlane {
  Eigen::Vector3d up;
  double height;
};

Eigen::Vector3d computeNormal(const DisparityPlane& plane, const StereoCamera& camera) {
  return {plane.x() * camera.left.fx, plane.y() * camera.left.fy, plane.z()};
}

/// Returns the plane normal . p = fx baseline.
SpacePlane toSpace(const DisparityPlane& plane, const StereoCamera& camera) {
  const Eigen::Vector3d normal = computeNormal(plane, camera);
  const double length = std::max(normal.norm(), 1e-12);
  return {-normal / length, camera.left.fx * camera.baseline / length};
}

Eigen::Vector3d toRow(const DensePoint& point, const StereoCamera& camera) {
  return {point.u - camera.left.cx, point.v - camera.left.cy, 1.0};
}

/// Small linear congruential generator (Knuth), equal on every platform.
class SampleGenerator {
 public:
  explicit SampleGenerator(std::uint32_t seed) : state_(seed * 2654435761U + 12345U) {}
  std::size_t below(std::size_t count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((state_ >> 33) % count);
  }

 private:
  std::uint64_t state_;
};

class GroundSearch {
 public:
  GroundSearch(const std::vector<DensePoint>& points, const StereoCamera& camera, const GroundOptions& options)
      : points_(points), camera_(camera), options_(options) {
    const Eigen::Vector3d assumed = -Eigen::Vector3d::UnitY();
    up_ = options.up ? options.up->normalized() : assumed;
    least_cosine_ = std::cos((options.up ? options.max_tilt_known : options.max_tilt_assumed) * kDegrees);
  }

  std::optional<DisparityPlane> sample() const {
    SampleGenerator random(options_.seed);
    const std::size_t stride = std::max<std::size_t>(points_.size() / kScoredPoints, 1);
    std::optional<DisparityPlane> best;
    double best_score = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      Eigen::Matrix3d rows;
      Eigen::Vector3d disparities;
      for (int k = 0; k < 3; ++k) {
        const DensePoint& point = points_[random.below(points_.size())];
        rows.row(k) = toRow(point, camera_);
        disparities[k] = static_cast<double>(point.disparity);
      }
      if (std::abs(rows.determinant()) < 100.0) continue;
      const DisparityPlane plane = rows.inverse() * disparities;
      if (!isNearGravity(plane)) continue;
      const double score = computeScore(plane, stride);
      if (score <= best_score) continue;
      best_score = score;
      best = plane;
    }
    return best;
  }

  bool isNearGravity(const DisparityPlane& plane) const {
    const SpacePlane space = toSpace(plane, camera_);
    return space.height > 0.0 && space.up.dot(up_) > least_cosine_;
  }

  /// Returns the variance of the difference between the disparities of a point and of the plane: noise, and roughness
  /// of `height` metres.
  double toleratedVariance(const DensePoint& point, double height) const {
    const double rough = options_.tolerance * static_cast<double>(point.disparity) / std::max(height, 0.05);
    return static_cast<double>(point.variance) + rough * rough;
  }

  /// Iteratively reweighted least squares with Tukey weights; `information` is that of the last iteration.
  DisparityPlane fit(DisparityPlane plane, Eigen::Matrix3d& information) const {
    double farthest = std::numeric_limits<double>::max();
    for (const DensePoint& point : points_) farthest = std::min(farthest, static_cast<double>(point.disparity));
    for (int i = 0; i < kFitSteps; ++i) {
      const double height = toSpace(plane, camera_).height;
      information.setZero();
      Eigen::Vector3d moment = Eigen::Vector3d::Zero();
      for (const DensePoint& point : points_) {
        const Eigen::Vector3d row = toRow(point, camera_);
        if (row.dot(plane) < kFarMargin * farthest)
          continue;  // points just beyond the range are missing depending on their noise
        const double residual = static_cast<double>(point.disparity) - row.dot(plane);
        const double squared = residual * residual / toleratedVariance(point, height) / 9.0;
        if (squared >= 1.0) continue;
        const double weight = (1.0 - squared) * (1.0 - squared) / toleratedVariance(point, height);
        information += weight * row * row.transpose();
        moment += weight * residual * row;
      }
      const Eigen::LDLT<Eigen::Matrix3d> factor(information + 1e-9 * Eigen::Matrix3d::Identity());
      plane += factor.solve(moment);
    }
    return plane;
  }

  /// Returns the share of all points on the plane, and the share of the ground's area: cells of the top view with a
  /// point on the plane, of those with a point in a band around the plane. Upright objects cover few cells, however
  /// many pixels they have.
  std::pair<double, double> findSupport(const SpacePlane& plane) const {
    double farthest = 0.0, on = 0.0;
    for (const DensePoint& point : points_) farthest = std::max(farthest, static_cast<double>(point.p_cam.norm()));
    const double cells_per_metre = 0.5 * kPlanCells / std::max(farthest, 1e-3);
    const Eigen::Vector3d forward = (Eigen::Vector3d::UnitZ() - plane.up.z() * plane.up).normalized();
    const Eigen::Vector3d right = forward.cross(plane.up);
    std::vector<std::uint8_t> plan(static_cast<std::size_t>(kPlanCells) * kPlanCells, 0);
    for (const DensePoint& point : points_) {
      const Eigen::Vector3d p = point.p_cam.cast<double>();
      const double height = plane.up.dot(p) + plane.height;
      const double sigma =
          std::sqrt(static_cast<double>(point.variance)) * plane.height / static_cast<double>(point.disparity);
      const bool is_on = std::abs(height) < 2.0 * options_.tolerance + 2.0 * sigma;
      on += is_on ? 1.0 : 0.0;
      if (!is_on && std::abs(height) >= kGroundBand) continue;
      const auto cell = [&](double metres) {
        return static_cast<std::size_t>(std::clamp(0.5 * kPlanCells + cells_per_metre * metres, 0.0, kPlanCells - 1.0));
      };
      plan[cell(forward.dot(p)) * kPlanCells + cell(right.dot(p))] |= is_on ? kOnPlane : kInBand;
    }
    double on_cells = 0.0, all_cells = 0.0;
    for (const std::uint8_t cell : plan) {
      on_cells += (cell & kOnPlane) != 0 ? 1.0 : 0.0;
      all_cells += cell != 0 ? 1.0 : 0.0;
    }
    return {on / static_cast<double>(points_.size()), all_cells > 0.0 ? on_cells / all_cells : 0.0};
  }

  /// Returns the first-order covariance of (up, height) from that of the plane's three coefficients.
  Eigen::Matrix4d computeCovariance(const DisparityPlane& plane, const Eigen::Matrix3d& information) const {
    const Eigen::Matrix3d coefficients = kPointsOfAWindow * pointsPerPixel() * information.inverse();
    const Eigen::Vector3d normal = computeNormal(plane, camera_), scale(camera_.left.fx, camera_.left.fy, 1.0);
    const double length = normal.norm();
    const Eigen::Vector3d unit = normal / length;
    Eigen::Matrix<double, 4, 3> jacobian;
    jacobian.topRows<3>() = -(Eigen::Matrix3d::Identity() - unit * unit.transpose()) / length * scale.asDiagonal();
    jacobian.bottomRows<1>() =
        -camera_.left.fx * camera_.baseline / (length * length) * unit.transpose() * scale.asDiagonal();
    return jacobian * coefficients * jacobian.transpose();
  }

 private:
  /// Returns the sampling density of the points: those of one window count as one measurement.
  double pointsPerPixel() const {
    int step = 9;  // between points of a row
    for (std::size_t i = 1; i < points_.size(); ++i)
      if (points_[i].v == points_[i - 1].v) step = std::min(step, std::max(points_[i].u - points_[i - 1].u, 1));
    return 1.0 / std::max(1, std::min(step * step, 80));
  }

  double computeScore(const DisparityPlane& plane, std::size_t stride) const {
    const double height = toSpace(plane, camera_).height;
    double score = 0.0;
    for (std::size_t i = 0; i < points_.size(); i += stride) {
      const double residual = static_cast<double>(points_[i].disparity) - toRow(points_[i], camera_).dot(plane);
      score += std::max(0.0, 1.0 - residual * residual / (6.0 * toleratedVariance(points_[i], height)));
    }
    return score;
  }

  const std::vector<DensePoint>& points_;
  const StereoCamera& camera_;
  const GroundOptions& options_;
  Eigen::Vector3d up_;
  double least_cosine_ = 0.0;
};

std::string percent(const char* before, double share, const char* after) {
  char text[120];
  std::snprintf(text, sizeof text, "%s%.0f %%%s", before, 100.0 * share, after);
  return text;
}

}  // namespace

const char* toString(GroundVerdict verdict) {
  static constexpr const char* kNames[] = {"found", "too_few_points", "no_plane", "not_planar"};
  return kNames[static_cast<std::size_t>(verdict)];
}

GroundPlane findGround(const std::vector<DensePoint>& points, const StereoCamera& camera,
                       const GroundOptions& options) {
  GroundPlane ground;
  if (points.size() < kLeastPoints) {
    ground.sentence =
        std::to_string(points.size()) + " points within range, " + std::to_string(kLeastPoints) + " wanted";
    return ground;
  }
  const GroundSearch search(points, camera, options);
  const std::optional<DisparityPlane> start = search.sample();
  ground.verdict = GroundVerdict::NoPlane;
  ground.sentence = "no plane near the direction of gravity";
  if (!start) return ground;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  const DisparityPlane plane = search.fit(*start, information);
  if (!search.isNearGravity(plane)) return ground;
  const SpacePlane space = toSpace(plane, camera);
  const auto [of_all, of_band] = search.findSupport(space);
  ground.support = of_band;
  if (of_all < kLeastSupport) {
    ground.sentence = percent("the best plane contains ", of_all, " of the points within range");
    return ground;
  }
  ground.up = space.up;
  ground.height = space.height;
  ground.covariance = search.computeCovariance(plane, information);
  const bool is_planar = of_band >= kLeastPlanarShare;
  ground.verdict = is_planar ? GroundVerdict::Found : GroundVerdict::NotPlanar;
  ground.sentence = is_planar ? "" : percent("the ground is not planar: ", of_band, " of it is on the best plane");
  return ground;
}

}  // namespace dense_stereo
