// SPDX-License-Identifier: BSD-3-Clause
#include "window/prior.hpp"

#include "urban_nav_core/geometry/dense_kernels.hpp"
#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

namespace kernels = urban_nav_core::kernels;

using Eigen::Map;
using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

namespace {

constexpr double kDegreesOfFreedom = 4.0;  // Student's t for calibration errors: common choice for data with outliers

}  // namespace

void Prior::start(const Pose& centre, const Matrix6d& pose_information) {
  has_pose = true;
  frozen = false;
  slots.clear();
  landmark_centre.clear();
  pose_centre = centre;
  information.reset(6);
  for (int j = 0; j < 6; ++j)
    for (int i = j; i < 6; ++i) information(i, j) = pose_information(i, j);
  eta.assign(6, 0.0);
  border.assign(6, 0.0);
}

void Prior::startOffset(double offset, double sigma) {
  has_offset = sigma > 0.0;
  calibrated_offset = offset;
  calibration_information = has_offset ? 1.0 / (sigma * sigma) : 0.0;
  offset_information = offset_eta = 0.0;
}

double Prior::calibrationInformation(double offset) const {
  const double off = offset - calibrated_offset;
  return calibration_information / (1.0 + off * off * calibration_information / kDegreesOfFreedom);
}

void Prior::deviation(const State& state, std::vector<double>& d) const {
  reserveWithHeadroom(d, static_cast<std::size_t>(size()));
  d.resize(static_cast<std::size_t>(size()));
  if (!has_pose) return;
  for (std::size_t i = 0; i < slots.size(); ++i)
    Map<Vector3d>(d.data() + 3 * i) = state.landmarks[static_cast<std::size_t>(slots[i])].estimate - landmark_centre[i];
  Map<Vector6d>(d.data() + landmarkSize()) = urban_nav_core::boxMinus(state.poses.front().estimate, pose_centre);
}

double Prior::gradient(const std::vector<double>& d, double offset, std::vector<double>& g, double& g_offset) const {
  const int n = size();
  reserveWithHeadroom(g, static_cast<std::size_t>(n));
  g.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) g[static_cast<std::size_t>(i)] = 0.0;
  for (int j = 0; j < n; ++j) {
    const double* below = information.column(j) + j + 1;
    double* rest = g.data() + j + 1;
    const double dj = d[static_cast<std::size_t>(j)];
    g[static_cast<std::size_t>(j)] -= below[-1] * dj + kernels::dot(below, d.data() + j + 1, n - j - 1);
    kernels::subtract(rest, below, dj, n - j - 1);
  }
  double cost = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    cost -= d[i] * (0.5 * g[i] + eta[i]);
    g[i] += eta[i];
  }
  g_offset = 0.0;
  if (!has_offset) return cost;
  const double tied = kernels::dot(border.data(), d.data(), n);
  kernels::subtract(g.data(), border.data(), offset, n);
  g_offset = offset_eta - tied - offset_information * offset;
  return cost + offset * (tied + 0.5 * offset_information * offset - offset_eta);
}

void Prior::recentre(const State& state) {
  if (!has_pose) return;
  deviation(state, d_);
  double g_offset = 0.0;
  gradient(d_, 0.0, g_, g_offset);
  eta.swap(g_);
  if (has_offset) offset_eta = g_offset;
  for (std::size_t i = 0; i < slots.size(); ++i)
    landmark_centre[i] = state.landmarks[static_cast<std::size_t>(slots[i])].estimate;
  pose_centre = state.poses.front().estimate;
}

void Prior::reserveLike(const Prior& other) {
  slots.reserve(other.slots.capacity());
  landmark_centre.reserve(other.landmark_centre.capacity());
  information.reserveLike(other.information);
  for (const auto& [own, others] : {std::pair(&eta, &other.eta), std::pair(&d_, &other.d_), std::pair(&g_, &other.g_)})
    own->reserve(others->capacity());
}

void Prior::archive(urban_nav_core::Archive& archive) {
  archive(has_pose, frozen, slots, landmark_centre, pose_centre, information, eta);
  archive(has_offset, border, offset_information, offset_eta, calibrated_offset, calibration_information);
  const auto rows = static_cast<std::size_t>(size());
  archive.require(landmark_centre.size() == slots.size() && information.size() == size() && eta.size() == rows &&
                      border.size() == rows,
                  "inconsistent block sizes of the prior");
}

}  // namespace swf_vo
