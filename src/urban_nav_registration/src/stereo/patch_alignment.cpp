// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/patch_alignment.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "urban_nav_core/camera/surface.hpp"
#include "urban_nav_core/image/patch.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_registration {

using urban_nav_core::PatchTemplate;
using urban_nav_core::PatchWarp;
using urban_nav_core::Pose;
using urban_nav_core::Pyramid;
using urban_nav_core::StereoCamera;

namespace {

constexpr double kLeastViewCorrelation = 0.8;  // as in swf_vo
constexpr double kLeastGain = 0.2, kLargestGain = 5.0;
constexpr double kSmallestScale = 0.3, kLargestScale = 3.5;  // scale of a patch between views: beyond, patches are not
                                                             // similar
constexpr double kMostStretch = 2.5;                         // ratio of the axes: a wall at a grazing angle
constexpr int kViewMargin = urban_nav_core::kPatchRadius + 3;
constexpr double kSamePointPx = 3.0;  // px of the level: a corner that was also detected in the other view
constexpr double kOwnWindowPx = 6.0;  // px of the level: nearer patches share pixels
constexpr double kLeastDepthShare =
    0.02;  // of the inverse depth: uncertainty of the disparity of one measurement with respect to the other
constexpr std::size_t kPatchGrain = 32;

struct Found {
  bool visible = false, found = false;
  double likeness = 0.0;
  double size = 1.0;  // px of level 0 per pixel of the level of the measurement
  PointMeasurement measurement;
};

/// Projection of a point into the other view, with the warp of its patch.
struct PointView {
  PatchWarp warp;
  Eigen::Vector2d pixel;
};

std::optional<PointView> findPlace(const StereoCamera& camera, const Eigen::Vector3d& plane, const Eigen::Vector3d& ray,
                                   const Pose& T_to_from) {
  const double rho = std::max(plane.dot(ray), 0.0);
  const auto warp = urban_nav_core::warpOfSurface(camera, plane, ray, T_to_from);
  if (!warp || !warp->A.allFinite() || !warp->bend.allFinite()) return std::nullopt;
  const Eigen::Vector3d p = T_to_from.q() * ray + T_to_from.t() * rho;
  if (!(p.z() > 0.05)) return std::nullopt;
  return PointView{*warp,
                   {camera.left.fx * p.x() / p.z() + camera.left.cx, camera.left.fy * p.y() / p.z() + camera.left.cy}};
}

/// Returns the scale of a warp; nullopt if it is too large, too small or too uneven.
std::optional<double> enlargement(const Eigen::Matrix2d& A) {
  const double area = A.determinant();
  if (!(area > kSmallestScale * kSmallestScale && area < kLargestScale * kLargestScale)) return std::nullopt;
  // squares of the singular values: s1 s2 = area^2, s1 + s2 = |A|^2
  const double half = 0.5 * A.squaredNorm();
  const double larger = half + std::sqrt(std::max(half * half - area * area, 0.0));
  if (larger / area > kMostStretch) return std::nullopt;
  return std::sqrt(area);
}

Found alignPoint(const StereoCamera& camera, const View& from, const View& to, const ViewPoint& point,
                 const Pose& T_to_from, double offset, const AligningOptions& options) {
  Found result;
  const double rho =
      std::max(0.0, (point.disparity - camera.disparity_offset - offset) / (camera.left.fx * camera.baseline));
  const Eigen::Vector3d plane = urban_nav_core::surfaceAt(point.plane, point.ray, rho);
  const auto place = findPlace(camera, plane, point.ray, T_to_from);
  if (!place) return result;
  const auto scale = enlargement(place->warp.A);
  if (!scale) return result;
  // Levels f and t at which the patches have similar size.
  int f = point.level + options.coarser;
  int t = f + static_cast<int>(std::lround(std::log2(*scale)));
  if (t < 0) {
    f -= t;
    t = 0;
  }
  if (f >= from.pyramid.levels() || t >= to.pyramid.levels()) return result;
  const double from_scale = Pyramid::scale(f), to_scale = Pyramid::scale(t);
  // The centre of the template is a whole pixel of its level, not the point itself.
  const int u = static_cast<int>(std::lround(point.pixel.x() * from_scale)),
            v = static_cast<int>(std::lround(point.pixel.y() * from_scale));
  const auto source = urban_nav_core::cutSource(from.pyramid.level(f), u, v);
  if (!source) return result;
  const Eigen::Vector2d middle = Eigen::Vector2d(u, v) / from_scale;
  const Eigen::Vector3d ray = camera.left.ray(middle);
  const auto of_middle = findPlace(camera, plane, ray, T_to_from);
  if (!of_middle) return result;
  const auto& image = to.pyramid.level(t);
  const Eigen::Vector2d start = of_middle->pixel * to_scale;
  if (!(start.x() >= kViewMargin && start.y() >= kViewMargin && start.x() < image.width - kViewMargin &&
        start.y() < image.height - kViewMargin))
    return result;
  PatchWarp warp(of_middle->warp.A * (to_scale / from_scale), of_middle->warp.bend / from_scale);
  warp.bend *= std::min(1.0, urban_nav_core::kLargestBend / std::max(warp.bend.norm(), 1e-9));
  PatchTemplate patch;
  if (!urban_nav_core::warpTemplate(*source, warp, patch)) return result;
  result.visible = true;
  result.likeness = urban_nav_core::correlationAt(image, patch, start);
  const auto aligned = urban_nav_core::alignPatch(image, patch, start, options.reach);
  if (!aligned.converged || aligned.correlation < kLeastViewCorrelation || aligned.gain < kLeastGain ||
      aligned.gain > kLargestGain || !aligned.covariance.allFinite())
    return result;
  result.found = true;
  result.size = 1.0 / to_scale;
  PointMeasurement& measurement = result.measurement;
  measurement.size = result.size;
  measurement.ray = ray;
  // disparity along the surface at the centre of the template
  measurement.disparity = point.disparity + camera.left.fx * camera.baseline * (plane.dot(ray) - plane.dot(point.ray));
  measurement.sigma_disparity = point.sigma_disparity;
  measurement.pixel = aligned.position * result.size;
  // Both images have noise; the alignment models that of one.
  measurement.covariance = 2.0 * aligned.covariance + options.floor_px * options.floor_px * Eigen::Matrix2d::Identity();
  measurement.covariance *= result.size * result.size;
  return result;
}

std::vector<Found> alignAllPoints(const StereoCamera& camera, const View& from, const View& to, const Pose& T_to_from,
                                  double offset, const AligningOptions& options) {
  std::vector<Found> found(from.points.size());
  urban_nav_core::forEach(from.points.size(), kPatchGrain, [&](std::size_t i) {
    found[i] = alignPoint(camera, from, to, from.points[i], T_to_from, offset, options);
    found[i].measurement.point = static_cast<int>(i);
  });
  return found;
}

}  // namespace

Aligned alignViews(const StereoCamera& camera, const View& a, const View& b, const Pose& T_a_b, double offset,
                   const AligningOptions& options) {
  Aligned result;
  std::vector<Found> of_a = alignAllPoints(camera, a, b, T_a_b.inverse(), offset, options);
  const std::vector<Found> of_b = alignAllPoints(camera, b, a, T_a_b, offset, options);
  const auto see = [&result](const Found& found) {
    if (!found.visible) return;
    ++result.visible;
    result.likeness += found.likeness;
  };
  std::vector<bool> taken(b.points.size(), false);
  for (Found& found : of_a) {
    see(found);
    if (!found.found) continue;
    PointMeasurement& measurement = found.measurement;
    double nearest = kSamePointPx * kSamePointPx;
    const ViewPoint* partner = nullptr;
    for (std::size_t j = 0; j < b.points.size(); ++j) {
      const double size = std::max(found.size, b.points[j].size());
      const double square = (b.points[j].pixel - measurement.pixel).squaredNorm() / (size * size);
      if (square < kOwnWindowPx * kOwnWindowPx) taken[j] = true;
      if (square >= nearest) continue;
      nearest = square;
      partner = &b.points[j];
    }
    if (partner != nullptr) {
      const double per_depth = camera.left.fx * camera.baseline;
      const double slope = partner->plane.dot(camera.left.ray(measurement.pixel)) - partner->plane.dot(partner->ray);
      measurement.other_disparity = partner->disparity + per_depth * slope;
      measurement.other_sigma =
          std::hypot(partner->sigma_disparity, per_depth * slope, kLeastDepthShare * measurement.other_disparity);
    }
    result.measurements.push_back(measurement);
  }
  for (std::size_t j = 0; j < of_b.size(); ++j) {
    if (taken[j]) continue;
    see(of_b[j]);
    if (!of_b[j].found) continue;
    result.measurements.push_back(of_b[j].measurement);
    result.measurements.back().of_a = false;
  }
  if (result.visible > 0) result.likeness /= result.visible;
  return result;
}

}  // namespace urban_nav_registration
