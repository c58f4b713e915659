// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/disparity_step.hpp"

#include <cmath>

namespace swf_vo {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

bool isCompared(const Match& match) { return match.left.found && match.right.found && match.track->seen >= 2; }

void listDifferences(const StereoCamera& camera, const Pose& T_camera_odom, const std::vector<Match>& matches,
                     const Eigen::Vector2d& known, std::vector<PixelDifference>& differences) {
  differences.clear();
  for (const Match& match : matches) {
    if (!isCompared(match)) continue;
    const Eigen::Vector3d p = T_camera_odom.q() * match.p_odom.head<3>() + T_camera_odom.t() * match.p_odom.w();
    if (!(p.z() > 1e-6)) continue;
    const double disparity = camera.left.fx * camera.baseline * match.p_odom.w() / p.z();
    PixelDifference difference;
    difference.px = match.left.pixel.x() - match.right.pixel.x() - camera.disparity_offset - disparity;
    const double x = (match.left.pixel.x() - camera.left.cx) / camera.left.fx,
                 y = (match.left.pixel.y() - camera.left.cy) / camera.left.fy;
    difference.px += camera.left.fx * (y * known.y() + x * y * known.x());
    difference.slope = {1.0 + x * x, disparity * disparity / (camera.left.fx * camera.baseline)};
    difference.cell = fitCell(match.left.pixel, camera.left.width, camera.left.height);
    differences.push_back(difference);
  }
}

}  // namespace

DisparityStep DisparityStepMeter::measure(const StereoCamera& camera, const Pose& T_camera_odom,
                                          const std::vector<Match>& matches, const Eigen::Vector2d& known) {
  differences_.reserve(matches.capacity());
  values_.reserve(matches.capacity());
  listDifferences(camera, T_camera_odom, matches, known, differences_);
  const RobustFit fit = fitRobustly(differences_, values_);
  if (!fit.found) return {};
  return {fit.value[0], std::sqrt(fit.covariance(0, 0)), fit.landmarks};
}

void DisparityStepMeter::addRows(const StereoCamera& camera, const RowMatch& match, double row_offset_px) {
  const double f = camera.left.fy, x = (match.right.x() - camera.left.cx) / camera.left.fx,
               y = (match.right.y() - camera.left.cy) / f;
  PixelDifference difference;
  difference.px = match.right.y() - match.left.y() - row_offset_px;
  difference.slope = {f * (1.0 + y * y), -f * x};
  difference.cell = fitCell(match.left, camera.left.width, camera.left.height);
  differences_.push_back(difference);
}

RowStep DisparityStepMeter::fitRows() {
  const RobustFit fit = fitRobustly(differences_, values_);
  if (!fit.found) return {};
  return {fit.value, fit.covariance.diagonal().cwiseSqrt()};
}

RowStep DisparityStepMeter::measureRows(const StereoCamera& camera, const std::vector<Match>& matches,
                                        double row_offset_px) {
  differences_.clear();
  differences_.reserve(matches.capacity());
  values_.reserve(matches.capacity());
  for (const Match& match : matches)
    if (isCompared(match)) addRows(camera, {match.left.pixel, match.right.pixel}, row_offset_px);
  return fitRows();
}

RowStep DisparityStepMeter::measureRows(const StereoCamera& camera, const std::vector<RowMatch>& matches,
                                        double row_offset_px) {
  differences_.clear();
  for (const RowMatch& match : matches) addRows(camera, match, row_offset_px);
  return fitRows();
}

}  // namespace swf_vo
