// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/depth_fusion.hpp"

#include <algorithm>
#include <cmath>

namespace laser_mapper {

using Eigen::Matrix3f;
using Eigen::Vector3f;

namespace {

constexpr float kAgreementGate = 3.0F;     // standard deviations within which two disparities agree
constexpr float kIndependentViews = 6.0F;  // limit, because images of one surface share matching errors
constexpr float kLeastDepth = 0.3F;        // m

/// Depth image seen from the camera of another one.
struct OtherView {
  const DepthFrame* frame = nullptr;
  Matrix3f R_other_own;
  Vector3f t_other_own;
};

/// Comparison of a point on a line of sight of one camera with the depth image of another one.
struct Comparison {
  enum class Kind { None, Agrees, Through } kind = Kind::None;
  float depth_error = 0.0F;  ///< m, its depth minus that of the point, along the line of sight
  float weight = 0.0F;       ///< 1/m^2
};

/// `ray`: direction of the point, with depth 1 in its own camera. `own_sigma`: of the point's depth, m.
Comparison compare(const OtherView& other, const Vector3f& ray, float depth, float own_sigma) {
  const DepthFrame& frame = *other.frame;
  const Vector3f along = other.R_other_own * ray;
  const Vector3f q = depth * along + other.t_other_own;
  if (q.z() < kLeastDepth) return {};
  const float per_step = 1.0F / frame.step;
  const auto u = static_cast<int>(std::lround((frame.fx * q.x() / q.z() + frame.cx) * per_step));
  const auto v = static_cast<int>(std::lround((frame.fy * q.y() / q.z() + frame.cy) * per_step));
  if (u < 0 || v < 0 || u >= frame.samples.width || v >= frame.samples.height) return {};
  const std::size_t at = frame.index(u, v);
  const float measured = frame.samples.disparity[at];
  if (!(measured > 0.0F)) return {};
  const float expected = frame.focal_baseline / q.z();
  const float slope = -expected / q.z() * along.z();  // px per m of depth
  const float sigma = std::hypot(frame.samples.sigma[at], frame.floor);
  const float difference = measured - expected;
  const float gate = kAgreementGate * std::hypot(sigma, slope * own_sigma);
  if (difference < -gate) return {Comparison::Kind::Through, 0.0F, 0.0F};
  if (difference > gate) return {};
  Comparison comparison;
  comparison.kind = Comparison::Kind::Agrees;
  if (std::abs(slope) > 1e-3F) {
    comparison.depth_error = difference / slope;
    comparison.weight = slope * slope / (sigma * sigma);
  }
  return comparison;
}

std::vector<OtherView> posedViews(const PosedDepth& own, const std::vector<PosedDepth>& others) {
  std::vector<OtherView> found;
  for (const PosedDepth& other : others) {
    if (other.frame == own.frame) continue;
    const urban_nav_core::Pose T_other_own = other.T_frame_camera.inverse() * own.T_frame_camera;
    found.push_back({other.frame, T_other_own.R().cast<float>(), T_other_own.t().cast<float>()});
  }
  return found;
}

}  // namespace

std::vector<FusedPoint> fuseDepth(const PosedDepth& own, const std::vector<PosedDepth>& others,
                                  const FusionRule& rule) {
  const DepthFrame& frame = *own.frame;
  const std::vector<OtherView> asked = posedViews(own, others);
  const Matrix3f R = own.T_frame_camera.R().cast<float>();
  const Vector3f t = own.T_frame_camera.t().cast<float>();
  std::vector<FusedPoint> points;
  for (int v = 0; v < frame.samples.height; ++v)
    for (int u = 0; u < frame.samples.width; ++u) {
      const std::size_t at = frame.index(u, v);
      const float disparity = frame.samples.disparity[at];
      if (!(disparity > 0.0F)) continue;
      const float depth = frame.focal_baseline / disparity;
      if (depth > rule.farthest || depth < kLeastDepth) continue;
      const Vector3f ray((frame.step * static_cast<float>(u) - frame.cx) / frame.fx,
                         (frame.step * static_cast<float>(v) - frame.cy) / frame.fy, 1.0F);
      const float sigma = depth / disparity * std::hypot(frame.samples.sigma[at], frame.floor);
      float weights = 1.0F / (sigma * sigma), errors = 0.0F;
      int views = 1, through = 0;
      for (const OtherView& other : asked) {
        const Comparison comparison = compare(other, ray, depth, sigma);
        if (comparison.kind == Comparison::Kind::Through) ++through;
        if (comparison.kind != Comparison::Kind::Agrees) continue;
        ++views;
        weights += comparison.weight;
        errors += comparison.weight * comparison.depth_error;
      }
      if (views < rule.fewest_views || 2 * through >= views) continue;
      const float shared = std::max(1.0F, static_cast<float>(views) / kIndependentViews);
      FusedPoint point;
      point.sigma = std::sqrt(shared / weights) * ray.norm();
      if (!(point.sigma <= rule.sigma_limit)) continue;
      point.p = R * ((depth + errors / weights) * ray) + t;
      point.grey = static_cast<float>(frame.samples.grey[at]);
      point.views = views;
      points.push_back(point);
    }
  return points;
}

}  // namespace laser_mapper
