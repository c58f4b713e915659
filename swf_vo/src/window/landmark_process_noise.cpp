// SPDX-License-Identifier: BSD-3-Clause
#include "window/landmark_process_noise.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/geometry/dense_kernels.hpp"
#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

namespace kernels = urban_nav_core::kernels;

void LandmarkProcessNoise::apply(const std::vector<Step>& steps, const std::vector<double>& directions, Prior& prior,
                                 Departed& departed) {
  for (std::size_t at = 0; at < steps.size(); at += kGroup)
    apply(steps.data() + at, static_cast<int>(std::min<std::size_t>(kGroup, steps.size() - at)), directions, prior,
          departed);
}

void LandmarkProcessNoise::gather(const Step* steps, int count, const Prior& prior) {
  const int n = prior.size();
  stride_ = static_cast<std::size_t>((n + kernels::kStrip - 1) / kernels::kStrip * kernels::kStrip);
  reserveWithHeadroom(columns_, stride_ * kMost);
  columns_.resize(stride_ * kMost);
  for (int k = 0; k < 2 * count; ++k) {
    row_[k] = 3 * steps[k / 2].block + k % 2;
    double* column = columns_.data() + static_cast<std::size_t>(k) * stride_;
    for (int i = 0; i < row_[k]; ++i) column[i] = prior.information(row_[k], i);
    std::copy(prior.information.column(row_[k]) + row_[k], prior.information.column(row_[k]) + n, column + row_[k]);
  }
}

void LandmarkProcessNoise::factor(const Step* steps, int count) {
  const int m = 2 * count;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i)
      L_[i][j] = columns_[static_cast<std::size_t>(j) * stride_ + static_cast<std::size_t>(row_[i])];
  for (int b = 0; b < count; ++b) {
    const Eigen::Matrix2d inverse = steps[b].covariance.inverse();
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) L_[2 * b + r][2 * b + c] += inverse(r, c);
  }
  for (int j = 0; j < m; ++j) {
    for (int k = 0; k < j; ++k)
      for (int i = j; i < m; ++i) L_[i][j] -= L_[i][k] * L_[j][k];
    // A pivot that is negative by rounding carries no information.
    const double root = L_[j][j] > 0.0 ? std::sqrt(L_[j][j]) : std::numeric_limits<double>::infinity();
    for (int i = j + 1; i < m; ++i) L_[i][j] /= root;
    L_[j][j] = root;
  }
}

void LandmarkProcessNoise::apply(const Step* steps, int count, const std::vector<double>& directions, Prior& prior,
                                 Departed& departed) {
  const int n = prior.size(), m = 2 * count;
  gather(steps, count, prior);
  factor(steps, count);
  const auto column = [&](int k) { return columns_.data() + static_cast<std::size_t>(k) * stride_; };
  for (int j = 0; j < m; ++j) {
    for (int k = 0; k < j; ++k) kernels::subtract(column(j), column(k), L_[j][k], n);
    for (int i = 0; i < n; ++i) column(j)[i] /= L_[j][j];
  }
  // y = L^-1 E^T v, v -= Pi E L^-T y: update of a row vector over the blocks.
  double y[kMost], tied[kMost];
  const auto change = [&](double* v, double* part) {
    for (int j = 0; j < m; ++j) {
      part[j] = v[row_[j]];
      for (int k = 0; k < j; ++k) part[j] -= L_[j][k] * part[k];
      part[j] /= L_[j][j];
    }
    for (int j = 0; j < m; ++j) kernels::subtract(v, column(j), part[j], n);
  };
  change(prior.eta.data(), y);
  std::fill(tied, tied + m, 0.0);
  if (prior.has_offset) {
    change(prior.border.data(), tied);
    for (int j = 0; j < m; ++j) {
      prior.offset_information -= tied[j] * tied[j];
      prior.offset_eta -= tied[j] * y[j];
    }
  }
  Eigen::Matrix<double, kMost, 6> held;
  for (int c = 0; c < 6; ++c)
    for (int j = 0; j < m; ++j) held(j, c) = kernels::dot(column(j), directions.data() + c * n, n);
  departed.gauge_loss.noalias() += held.topRows(m).transpose() * held.topRows(m);
  for (int r = 0; r < 6; ++r) {
    change(departed.gain.data() + r * n, y);
    for (int j = 0; j < m; ++j) {
      departed.offset_gain[r] -= y[j] * tied[j];
      departed.gauge_gain.row(r) -= y[j] * held.row(j);
    }
  }
  product_.subtract(prior.information, 0, n, columns_.data(), m, static_cast<int>(stride_));
}

}  // namespace swf_vo
