// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/refine.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "urban_nav_core/camera/surface.hpp"

namespace swf_vo {

using urban_nav_core::Alignment;
using urban_nav_core::PatchTemplate;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

constexpr double kLargestScale = 1.5, kSmallestScale = 0.6;
constexpr double kSameWarp = 0.02;   // difference of an element: 0.1 px at the border of the window
constexpr double kSameBend = 0.002;  // 1/px, half of that at the border
constexpr double kRowGate = 9.0;     // chi-square of the difference of the rows, one degree of freedom
constexpr double kRowSlackPx = 0.3;  // rectification error
constexpr double kFurther = 1.4;     // the slant is updated each time the camera has moved further by this factor
constexpr double kSteepest = 20.0;   // change of a surface's slant in one step, tangent
constexpr double kSameBlur = 0.05;   // px^2 of the level
// Uncertainty of the displacement caused by blur, as a share of it: errors of the blur measured at edges, and
// deviations from a Gaussian.
constexpr double kBlurShare = 0.3;
constexpr double kLeastGain = 0.2, kLargestGain = 5.0;
// As the view changes, the pixels of a template are weighted differently, and the point that it represents drifts over
// the surface, equally in both images, so that disparities do not change. For a view change of one its variance grows
// by this multiple of the alignment's covariance and of kCreepPx^2: a patch of several depths has increasing residuals
// and drifts most. Measured in simulated streets (bench/template_drift); planar patches drift by half of that at most
// (bench/creep).
constexpr double kCreepPerChange = 4.0, kCreepPx = 0.03;

}  // namespace

double inverseDepthWhereBorn(const Match& match) {
  const Eigen::Vector3d p =
      match.track->T_born_odom.q() * match.p_odom.head<3>() + match.track->T_born_odom.t() * match.p_odom.w();
  return p.z() > 1e-9 ? match.p_odom.w() / p.z() : 0.0;
}

bool prepareTemplate(Side side, const StereoCamera& camera, const Pose& T_camera_odom, Match& match) {
  Track& track = *match.track;
  const bool is_left = side == Side::Left;
  const Eigen::Vector2d& blur = track.blur;
  if (track.sharper || blur.maxCoeff() > urban_nav_core::kLargestBlur) return false;
  const Pose T_camera_born = T_camera_odom * track.T_born_odom.inverse();
  auto warp = warpInto(side, camera, track, T_camera_born, inverseDepthWhereBorn(match));
  if (!warp || !warp->A.allFinite() || !warp->bend.allFinite()) return false;
  warp->bend /= urban_nav_core::Pyramid::scale(track.level);
  warp->bend *= std::min(1.0, urban_nav_core::kLargestBend / std::max(warp->bend.norm(), 1e-9));
  const double area = warp->A.determinant();
  if (!(area > kSmallestScale * kSmallestScale && area < kLargestScale * kLargestScale)) return false;
  PatchTemplate &result = is_left ? track.in_left : track.in_right, &others = is_left ? track.in_right : track.in_left;
  bool &ready = is_left ? track.left_ready : track.right_ready,
       &others_ready = is_left ? track.right_ready : track.left_ready;
  Eigen::Vector2d &made_blur = is_left ? track.made_blur_left : track.made_blur_right,
                  &others_blur = is_left ? track.made_blur_right : track.made_blur_left;
  const auto serves = [&](const PatchTemplate& patch, const Eigen::Vector2d& its_blur) {
    return (patch.warp.A - warp->A).cwiseAbs().maxCoeff() < kSameWarp &&
           (patch.warp.bend - warp->bend).cwiseAbs().maxCoeff() < kSameBend &&
           (its_blur - blur).cwiseAbs().maxCoeff() < kSameBlur;
  };
  if (ready && serves(result, made_blur)) return true;
  // The template of the other image serves for surfaces that face both cameras.
  ready = others_ready && serves(others, others_blur);
  made_blur = ready ? others_blur : blur;
  if (ready) result = others;
  else if (blur.isZero()) ready = urban_nav_core::warpTemplate(track.source, *warp, result);
  else ready = urban_nav_core::warpTemplate(urban_nav_core::blurred(track.source, blur), *warp, result);
  return ready;
}

PixelMeasurement refine(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& start,
                        double reach) {
  PixelMeasurement sighting;
  const double size = 1.0 / urban_nav_core::Pyramid::scale(track.level);
  const PatchTemplate& result = side == Side::Left ? track.in_left : track.in_right;
  const Alignment a = urban_nav_core::alignPatch(corners.image(side, track.level), result, start / size, reach);
  if (!a.converged || a.correlation < kLeastCorrelation || a.gain < kLeastGain || a.gain > kLargestGain)
    return sighting;
  sighting.found = true;
  sighting.pixel = a.position * size;
  sighting.covariance = a.covariance * (size * size);
  sighting.correlation = a.correlation;
  sighting.gain = a.gain;
  sighting.noise = a.noise;
  return sighting;
}

void learnSurface(const Corners& corners, const StereoCamera& camera, const Pose& T_camera_odom, Match& match) {
  Track& track = *match.track;
  const double inverse_depth = inverseDepthWhereBorn(match);
  const Eigen::Vector2d direction =
      slantDirection(camera, track, T_camera_odom * track.T_born_odom.inverse(), inverse_depth);
  if (!match.left.found || !track.left_ready || !(direction.norm() > kFurther * track.slant_reach)) return;
  Alignment alignment;
  alignment.converged = true;
  alignment.position = match.left.pixel * urban_nav_core::Pyramid::scale(track.level);
  alignment.gain = match.left.gain;
  alignment.noise = match.left.noise;
  const Eigen::Vector3d plane = surfaceAt(track, inverse_depth);
  const Eigen::Vector2d assumed(plane.x(), plane.y() * camera.left.fx / camera.left.fy);
  urban_nav_core::Slope slant = track.slant;
  urban_nav_core::seeSlant(corners.image(Side::Left, track.level), track.source, track.in_left, alignment, direction,
                           assumed, slant);
  track.slant_reach = direction.norm();
  if (!(inverse_depth > 0.0)) return;
  const Eigen::Vector2d mean = slant.under(inverse_depth).mean;
  if (!((mean - assumed).norm() < kSteepest * std::max(inverse_depth, 1e-3))) return;
  track.slant = slant;
  track.plane = urban_nav_core::leaning(camera, track.ray, inverse_depth, mean);
}

Eigen::Matrix2d creep(const StereoCamera& camera, const Pose& T_camera_odom, Match& match) {
  Track& track = *match.track;
  const auto warp =
      warpInto(Side::Left, camera, track, T_camera_odom * track.T_born_odom.inverse(), inverseDepthWhereBorn(match));
  if (!warp || !warp->A.allFinite() || !(std::abs(warp->A.determinant()) > 1e-3)) return Eigen::Matrix2d::Zero();
  const double change = (warp->A * track.seen_as.inverse() - Eigen::Matrix2d::Identity()).norm();
  track.seen_as = warp->A;
  const Eigen::Matrix2d& aligned = match.left.found ? match.left.covariance : match.right.covariance;
  return change * kCreepPerChange * (aligned + kCreepPx * kCreepPx * Eigen::Matrix2d::Identity());
}

Eigen::Matrix2d whereBorn(const Track& track, const Eigen::Matrix2d& covariance) {
  const Eigen::Matrix2d born_from_now = track.seen_as.inverse();
  return born_from_now * covariance * born_from_now.transpose();
}

Eigen::Matrix2d displacedByBlur(const Track& track, bool in_left) {
  const Eigen::Vector2d& blur = in_left ? track.made_blur_left : track.made_blur_right;
  const PatchTemplate& result = in_left ? track.in_left : track.in_right;
  PatchTemplate sharp;
  if (blur.isZero() || !urban_nav_core::warpTemplate(track.source, result.warp, sharp)) return Eigen::Matrix2d::Zero();
  const Eigen::Vector2d d =
      kBlurShare * urban_nav_core::displacement(result, sharp) / urban_nav_core::Pyramid::scale(track.level);
  return d * d.transpose();
}

void loosen(const Eigen::Matrix2d& covariance, double of_disparity, Match& match) {
  const bool left = match.left.found, right = match.right.found;
  Eigen::Matrix<double, 2, 3> pick = Eigen::Matrix<double, 2, 3>::Zero();
  pick(1, 1) = 1.0;
  if (left && right) {
    pick(0, 0) = pick(0, 2) = 1.0;
    Eigen::Matrix3d R = match.information.inverse() + pick.transpose() * covariance * pick;
    R(2, 2) += of_disparity;
    match.information = R.inverse();
  } else {
    pick(0, left ? 0 : 2) = 1.0;
    const Eigen::Matrix2d own = pick * match.information * pick.transpose();
    match.information = pick.transpose() * (own.inverse() + covariance).inverse() * pick;
  }
  match.information = (0.5 * (match.information + match.information.transpose())).eval();
}

void roundToPixels(Match& match) {
  const double size = 1.0 / urban_nav_core::Pyramid::scale(match.track->level);
  for (PixelMeasurement* sighting : {&match.left, &match.right}) {
    if (!sighting->found) continue;
    for (double& coordinate : sighting->pixel) coordinate = size * std::round(coordinate / size);
    sighting->covariance = size * size / 12.0 * Eigen::Matrix2d::Identity();
  }
}

void combine(double floor_px, Match& match, double row_offset) {
  match.measured = false;
  match.information.setZero();
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  const Eigen::Matrix2d floor = floor_px * floor_px * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d in_right = match.right.pixel - Eigen::Vector2d(0.0, row_offset);
  const auto add = [&](const PixelMeasurement& sighting, const Eigen::Vector2d& pixel, int column) {
    if (!sighting.found) return;
    const Eigen::Matrix2d information = (sighting.covariance + floor).inverse();
    Eigen::Matrix<double, 2, 3> pick = Eigen::Matrix<double, 2, 3>::Zero();
    pick(0, column) = 1.0;
    pick(1, 1) = 1.0;
    match.information += pick.transpose() * information * pick;
    weighted += pick.transpose() * (information * pixel);
  };
  if (match.left.found && match.right.found) {
    const double difference = match.left.pixel.y() - in_right.y();
    const double variance = match.left.covariance(1, 1) + match.right.covariance(1, 1) + kRowSlackPx * kRowSlackPx;
    if (difference * difference > kRowGate * variance) return;
  }
  add(match.left, match.left.pixel, 0);
  add(match.right, in_right, 2);
  if (match.left.found && match.right.found) {
    match.z = match.information.ldlt().solve(weighted);
  } else if (match.left.found) {
    match.z << match.left.pixel, 0.0;
  } else if (match.right.found) {
    match.z << 0.0, in_right.y(), in_right.x();
  }
  match.measured = (match.left.found || match.right.found) && match.z.allFinite() && match.information.allFinite();
}

}  // namespace swf_vo
