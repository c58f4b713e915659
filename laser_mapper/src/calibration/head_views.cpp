// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/head_views.hpp"

#include <cmath>
#include <optional>

#include "calibration/view_brightness.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kNearestSeen = 0.3, kLensStep = 1e-4;  // m; step of the tangents for numeric derivatives
constexpr double kLeastIncidence = 0.2;  // cosine: at larger angles to the normal, a view has little information on a
                                         // surface
constexpr std::size_t kHeadPointGrain = 32;
constexpr urban_nav_core::StampNs kLongestMomentGap = 500'000'000;

/// Pixel, and its derivatives with respect to the point in the frame of the camera.
struct LensPoint {
  Vector2d pixel;
  Eigen::Matrix<double, 2, 3> derivatives;
};

std::optional<LensPoint> throughLens(const urban_nav_core::RawCamera& camera, const Vector3d& q) {
  if (q.z() < kNearestSeen) return std::nullopt;
  const Vector3d ray = q / q.z();
  const auto pixel = camera.project(ray), right = camera.project(ray + kLensStep * Vector3d::UnitX()),
             below = camera.project(ray + kLensStep * Vector3d::UnitY());
  if (!pixel || !right || !below) return std::nullopt;
  Eigen::Matrix2d lens;
  lens << (*right - *pixel) / kLensStep, (*below - *pixel) / kLensStep;
  Eigen::Matrix<double, 2, 3> division;
  division << 1.0, 0.0, -ray.x(), 0.0, 1.0, -ray.y();
  return LensPoint{*pixel, lens * division / q.z()};
}

}  // namespace

HeadViews::HeadViews(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base, const Vector3d& centre,
                     const std::vector<FreeTrajectory>& stretches)
    : images_(images), T_map_base_(T_map_base), centre_(centre), stretches_(stretches) {
  for (const MountedView& view : images.views) moments_.push_back(momentAt(view.stamp));
  for (std::size_t first = 0, last = 0; first < images.sightings.size(); first = last) {
    const std::uint32_t point = images.sightings[first].point;
    while (last < images.sightings.size() && images.sightings[last].point == point) ++last;
    points_.push_back({momentAt(images.stamps[point]), first, last});
  }
}

HeadMoment HeadViews::momentAt(urban_nav_core::StampNs stamp) const {
  HeadMoment moment;
  while (moment.stretch + 1 < stretches_.size() && stamp >= stretches_[moment.stretch].interval().end) ++moment.stretch;
  if (!stretches_.empty()) moment.share = stretches_[moment.stretch].shareAt(stamp);
  if (const auto pose = T_map_base_.at(stamp, kLongestMomentGap)) moment.base = pose->t();
  return moment;
}

/// Returns the displacement of a map point by the corrections of the trajectory, as seen from a view.
Vector3d HeadViews::displacement(const HeadMoment& measured, const HeadMoment& seen, const Vector3d& p) const {
  const auto moved = [&](const HeadMoment& moment) {
    const PoseCorrection correction = stretches_[moment.stretch].correctionAt(moment.share);
    return Vector3d(correction.head<3>() + correction.tail<3>().cross(p - moment.base));
  };
  return moved(measured) - moved(seen);
}

std::vector<HeadRow> HeadViews::rowsAt(const TermVector& terms, int level, bool corrected) const {
  std::vector<std::optional<ViewMotion>> motions(images_.views.size());
  for (std::size_t i = 0; i < motions.size(); ++i)
    motions[i] = viewMotionAt(images_.views[i], T_map_base_, centre_, terms);
  std::vector<HeadRow> rows(images_.sightings.size());
  const auto look = [&](const HeadPoint& point, std::size_t i) {
    const HeadSighting& sighting = images_.sightings[i];
    const auto& motion = motions[sighting.view];
    const HeadMoment& seen = moments_[sighting.view];
    if (!motion || seen.stretch != point.measured.stretch) return;
    Vector3d p = images_.points[sighting.point];
    if (corrected) p += displacement(point.measured, seen, p);
    const Vector3d& normal = images_.normals[sighting.point];
    const Vector3d q = motion->R * p + motion->t;
    if (std::abs((motion->R * normal).dot(q.normalized())) < kLeastIncidence) return;
    const auto lens = throughLens(images_.views[sighting.view].camera, q);
    if (!lens) return;
    const auto shown = brightnessAt(images_.pyramids[sighting.view], level, lens->pixel);
    if (!shown) return;
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = normal.unitOrthogonal();
    axes.col(1) = normal.cross(axes.col(0));
    const Eigen::Matrix2d px_per_m = lens->derivatives * motion->R * axes;
    const Eigen::Matrix<double, 2, 3> along_surface = px_per_m.inverse() * lens->derivatives;
    const HeadRow::TermShifts shifts = (along_surface * motion->derivatives(p)).cast<float>();
    if (!shifts.allFinite()) return;
    const Eigen::Vector2f texture = (px_per_m.transpose() * shown->slope).cast<float>();
    rows[i].brightness = static_cast<float>(shown->value);
    Eigen::Map<HeadRow::TermShifts>(rows[i].shifts.data()) = shifts;
    Eigen::Map<HeadRow::PointShifts>(rows[i].motion.data()) = (along_surface * motion->R).cast<float>();
    rows[i].texture = {texture.x(), texture.y()};
    rows[i].is_seen = true;
  };
  urban_nav_core::forEach(points_.size(), kHeadPointGrain, [&](std::size_t number) {
    for (std::size_t i = points_[number].first; i < points_[number].last; ++i) look(points_[number], i);
  });
  return rows;
}

}  // namespace laser_mapper
