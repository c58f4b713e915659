// SPDX-License-Identifier: BSD-3-Clause
#include "window/pose_elimination.hpp"

#include <algorithm>
#include <cmath>

namespace swf_vo {

using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

constexpr double kLeastPathPivot = 1e-12;

bool isState(const LandmarkBlock& landmark) {
  return landmark.used && !landmark.known && (landmark.prior >= 0 || !landmark.seen.empty());
}

}  // namespace

double PoseElimination::operations(std::size_t poses, std::size_t landmarks) {
  const double p = 6.0 * static_cast<double>(poses), m = 3.0 * static_cast<double>(landmarks);
  return m * m * m / 6.0 + m * m * p / 2.0 + 12.0 * m * p;
}

void PoseElimination::gather(const State& state, const Prior& prior, const NormalEquations& equations) {
  const std::size_t poses = state.poses.size();
  row_.assign(state.landmarks.size(), -1);
  map_size_ = 0;
  for (const int slot : prior.slots) {
    row_[static_cast<std::size_t>(slot)] = map_size_;
    map_size_ += 3;
  }
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    if (row_[slot] >= 0 || !isState(state.landmarks[slot])) continue;
    row_[slot] = map_size_;
    map_size_ += 3;
  }
  dense_.reset(map_size_);
  stride_ = static_cast<std::size_t>(dense_.stride());
  across_.assign(stride_ * 6 * poses, 0.0);
  floor_.assign(static_cast<std::size_t>(map_size_), 1.0);
  const int marginal = prior.landmarkSize();
  for (int j = 0; j < marginal; ++j) {
    std::copy(prior.information.column(j) + j, prior.information.column(j) + marginal, dense_.column(j) + j);
    for (int c = 0; c < 6 && prior.has_pose; ++c)
      across(static_cast<std::size_t>(c))[j] = prior.information(marginal + c, j);
  }
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    if (row_[slot] < 0) continue;
    const int row = row_[slot];
    for (int c = 0; c < 3; ++c)
      for (int r = c; r < 3; ++r) dense_(row + r, row + c) += equations.landmark[slot](r, c);
    std::size_t cross = static_cast<std::size_t>(equations.first_cross[slot]);
    for (const Measurement& measurement : state.landmarks[slot].seen) {
      const std::size_t column = 6 * static_cast<std::size_t>(measurement.step - state.first_step);
      const Matrix63d& E = equations.cross[cross++];
      for (std::size_t c = 0; c < 6; ++c)
        for (int r = 0; r < 3; ++r) across(column + c)[row + r] += E(static_cast<Eigen::Index>(c), r);
    }
  }
}

void PoseElimination::factorPose(std::size_t j, const Vector6d& diagonal) {
  Link& link = links_[j];
  const Matrix6d& D = pivots_[j];
  link.L.setZero();
  for (int c = 0; c < 6; ++c) {
    double pivot = D(c, c);
    for (int k = 0; k < c; ++k) pivot -= link.L(c, k) * link.L(c, k);
    link.held[c] = !(pivot > kLeastPathPivot * diagonal[c]) || !(pivot > 0.0);
    link.L(c, c) = std::sqrt(link.held[c] ? process_model::floor()(c, c) : pivot);
    if (link.held[c]) continue;
    for (int r = c + 1; r < 6; ++r) {
      double value = D(r, c);
      for (int k = 0; k < c; ++k) value -= link.L(r, k) * link.L(c, k);
      link.L(r, c) = value / link.L(c, c);
    }
  }
}

void PoseElimination::factor(const State& state, const Prior& prior, const NormalEquations& equations,
                             double datum_strength) {
  const std::size_t poses = state.poses.size();
  gather(state, prior, equations);
  links_.resize(poses);
  pivots_ = equations.pose;
  if (prior.has_pose)
    for (int c = 0; c < 6; ++c)
      for (int r = c; r < 6; ++r) {
        const double value = prior.information(prior.landmarkSize() + r, prior.landmarkSize() + c);
        pivots_[0](r, c) += value;
        if (r != c) pivots_[0](c, r) += value;
      }
  for (int c = 0; c < 6; ++c)
    pivots_[0](c, c) += datum_strength > 0.0 ? datum_strength * (1.0 + pivots_[0](c, c)) : 0.0;
  Vector6d diagonal = pivots_[0].diagonal();
  for (std::size_t j = 0; j < poses; ++j) {
    factorPose(j, diagonal);
    Link& link = links_[j];
    const bool last = j + 1 == poses;
    if (!last) {
      link.next = equations.next[j];
      diagonal = pivots_[j + 1].diagonal();
    }
    // X L^-T column by column; held columns are excluded.
    for (int c = 0; c < 6; ++c) {
      double* column = across(6 * j + static_cast<std::size_t>(c));
      const double inverse = link.held[c] ? 0.0 : 1.0 / link.L(c, c);
      for (int k = 0; k < c; ++k) {
        kernels::subtract(column, across(6 * j + static_cast<std::size_t>(k)), link.L(c, k), map_size_);
        if (!last) link.next.col(c) -= link.next.col(k) * link.L(c, k);
      }
      for (int r = 0; r < map_size_; ++r) column[r] *= inverse;
      if (!last) link.next.col(c) *= inverse;
    }
    if (last) break;
    pivots_[j + 1].noalias() -= link.next * link.next.transpose();
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t k = 0; k < 6; ++k)
        kernels::subtract(across(6 * (j + 1) + c), across(6 * j + k),
                          link.next(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)), map_size_);
  }
  if (map_size_ == 0) return;
  product_.subtract(dense_, 0, map_size_, across_.data(), static_cast<int>(6 * poses), static_cast<int>(stride_));
  cholesky_.factor(dense_, floor_);
}

void PoseElimination::solve(std::vector<double>& path, std::vector<double>& map, bool hold) const {
  using Column = Eigen::Map<Vector6d>;
  for (std::size_t j = 0; j < links_.size(); ++j) {
    Column y(path.data() + 6 * j);
    links_[j].L.triangularView<Eigen::Lower>().solveInPlace(y);
    for (int c = 0; c < 6 && hold; ++c)
      if (links_[j].held[c]) y[c] = 0.0;
    if (j + 1 < links_.size()) Column(path.data() + 6 * (j + 1)) -= links_[j].next * y;
    for (std::size_t c = 0; c < 6; ++c)
      kernels::subtract(map.data(), across(6 * j + c), y[static_cast<Eigen::Index>(c)], map_size_);
  }
  if (map_size_ > 0) {
    cholesky_.solveLower(map.data());
    if (hold) cholesky_.release(map.data());
    cholesky_.solveUpper(map.data());
  }
  for (std::size_t j = links_.size(); j-- > 0;) {
    Column y(path.data() + 6 * j);
    if (j + 1 < links_.size()) y -= links_[j].next.transpose() * Column(path.data() + 6 * (j + 1));
    for (std::size_t c = 0; c < 6; ++c)
      y[static_cast<Eigen::Index>(c)] -= kernels::dot(across(6 * j + c), map.data(), map_size_);
    links_[j].L.transpose().triangularView<Eigen::Upper>().solveInPlace(y);
  }
}

void PoseElimination::archive(urban_nav_core::Archive& archive) {
  std::size_t poses = links_.size();
  archive.count(poses);
  if (archive.isReading()) links_.resize(poses);
  for (std::size_t j = 0; j < poses; ++j) {
    archive(links_[j].L);
    if (j + 1 < poses) archive(links_[j].next);
    for (bool& held : links_[j].held) archive(held);
  }
  archive(map_size_, across_);
  if (map_size_ > 0) cholesky_.archive(archive, dense_);
  if (archive.isReading() && map_size_ == 0) dense_.reset(0);
  stride_ = static_cast<std::size_t>(dense_.stride());
  archive.require(map_size_ == dense_.size() && across_.size() == stride_ * 6 * poses, "invalid size of a factor");
}

}  // namespace swf_vo
