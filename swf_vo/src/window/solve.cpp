// SPDX-License-Identifier: BSD-3-Clause
#include "window/solve.hpp"

#include <algorithm>
#include <cmath>

#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

constexpr double kLeastSolvePivot = 1e-12;
// The alternative order must have at most this share of the operations: its panels are narrow.
constexpr double kWorthChanging = 0.7;
// Columns of eliminated landmarks processed together.
constexpr int kSolvePanel = 48;
constexpr std::size_t kMostRows = 1 << 20;  // limit for an archived factor
// Arbitrary; this value gives the oldest pose a negligible variance.
constexpr double kDatumStrength = 1e3;
// The disparity offset is estimated from the change of disparities with distance, as are all errors that the models of
// camera and surfaces neglect: in rendered rooms without an offset, and on real sequences, the error of its estimate is
// 2 to 30 times its standard deviation. Its information is divided by this number (standard deviation times 20), less
// the inflation that is already in the measurements.
constexpr double kCaution = 400.0;

double cautionFor(const State& state) {
  double sum = 0.0, count = 0.0;
  for (const LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used) continue;
    for (const Measurement& measurement : landmark.seen) sum += measurement.inflation;
    count += static_cast<double>(landmark.seen.size());
  }
  return count > 0.0 ? std::max(1.0, kCaution * count / sum) : kCaution;
}

bool isFree(const LandmarkBlock& landmark) { return landmark.used && !landmark.known && landmark.prior < 0; }

// R, lower triangular, with R^T R = C^-1; rows of undetermined directions are zero.
Matrix3d inverseRoot(const Matrix3d& C) {
  Matrix3d L = Matrix3d::Zero();
  bool held[3] = {false, false, false};
  for (int j = 0; j < 3; ++j) {
    double pivot = C(j, j);
    for (int k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    held[j] = !(pivot > kLeastSolvePivot * C(j, j)) || !(pivot > 0.0);
    if (held[j]) {
      L(j, j) = 1.0;
      continue;
    }
    L(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 3; ++i) {
      double value = C(i, j);
      for (int k = 0; k < j; ++k) value -= L(i, k) * L(j, k);
      L(i, j) = value / L(j, j);
    }
  }
  Matrix3d R = Matrix3d::Zero();
  for (int j = 0; j < 3; ++j) {
    R(j, j) = 1.0 / L(j, j);
    for (int i = j + 1; i < 3; ++i) {
      double value = 0.0;
      for (int k = j; k < i; ++k) value -= L(i, k) * R(k, j);
      R(i, j) = value / L(i, i);
    }
  }
  for (int j = 0; j < 3; ++j)
    if (held[j]) {
      R.row(j).setZero();
      R.col(j).setZero();
    }
  return R;
}

void addBlock(DenseMatrix& M, int row, int column, const double* block, int rows, int columns) {
  for (int c = 0; c < columns; ++c) {
    double* to = M.column(column + c) + row;
    for (int r = 0; r < rows; ++r) to[r] += block[c * rows + r];
  }
}

}  // namespace

void Solver::eliminateFree(const State& state, const NormalEquations& equations) {
  reserveWithHeadroom(eliminated_, equations.cross.size());
  eliminated_.resize(equations.cross.size());
  inverse_root_.resize(state.landmarks.size());
  onto_poses_.reset(6 * static_cast<int>(poses_));
  columns_.assign(static_cast<std::size_t>(onto_poses_.stride()) * kSolvePanel, 0.0);
  Strip strip;
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state.landmarks[slot];
    if (!isFree(landmark) || landmark.seen.empty()) continue;
    const Matrix3d& R = inverse_root_[slot] = inverseRoot(equations.landmark[slot]);
    std::size_t cross = static_cast<std::size_t>(equations.first_cross[slot]);
    for (const Measurement& measurement : landmark.seen) {
      const int row = 6 * static_cast<int>(measurement.step - state.first_step);
      Matrix63d& F = eliminated_[cross];
      F.noalias() = equations.cross[cross] * R.transpose();
      ++cross;
      for (int c = 0; c < 3; ++c)
        Map<Vector6d>(columns_.data() +
                      static_cast<std::size_t>(strip.columns + c) * static_cast<std::size_t>(onto_poses_.stride()) +
                      row) = F.col(c);
      strip.first = std::min(strip.first, row);
      strip.last = std::max(strip.last, row + 6);
    }
    strip.columns += 3;
    if (strip.columns + 3 > kSolvePanel) subtractStrip(strip);
  }
  subtractStrip(strip);
  for (int j = 0; j < onto_poses_.size(); ++j) {
    const double* from = onto_poses_.column(j);
    double* to = dense_.column(static_cast<int>(offset_) + j) + offset_;
    for (int i = j; i < onto_poses_.size(); ++i) to[i] += from[i];
  }
}

// Slots are roughly in order of first observation, so that the landmarks of one strip were observed from similar poses.
void Solver::subtractStrip(Strip& strip) {
  if (strip.columns > 0) {
    const int first = strip.first / kernels::kStrip * kernels::kStrip;
    const int last =
        std::min(onto_poses_.size(), (strip.last + kernels::kStrip - 1) / kernels::kStrip * kernels::kStrip);
    product_.subtract(onto_poses_, first, last - first, columns_.data() + first, strip.columns, onto_poses_.stride());
    for (int c = 0; c < strip.columns; ++c) {
      double* column = columns_.data() + static_cast<std::size_t>(c) * static_cast<std::size_t>(onto_poses_.stride());
      std::fill(column + first, column + last, 0.0);
    }
  }
  strip = Strip();
}

bool Solver::isCheaperPosesFirst(const State& state, const Prior& prior) const {
  if (elimination_ != Elimination::Cheaper) return elimination_ == Elimination::PosesFirst;
  std::size_t free = 0;
  for (const LandmarkBlock& landmark : state.landmarks) free += isFree(landmark) && !landmark.seen.empty() ? 1 : 0;
  const double path = 6.0 * static_cast<double>(state.poses.size()),
               dense = 3.0 * static_cast<double>(prior.slots.size()) + path;
  const double onto_path = dense * dense * dense / 6.0 + 1.5 * static_cast<double>(free) * path * path;
  return PoseElimination::operations(state.poses.size(), prior.slots.size() + free) < kWorthChanging * onto_path;
}

void Solver::factor(const State& state, const Prior& prior, const NormalEquations& equations, bool datum) {
  poses_ = state.poses.size();
  offset_ = static_cast<std::size_t>(prior.landmarkSize());
  poses_first_ = isCheaperPosesFirst(state, prior);
  if (poses_first_) pose_elimination_.factor(state, prior, equations, datum ? kDatumStrength : 0.0);
  else factorLandmarksFirst(state, prior, equations, datum);
  border_.used = prior.has_offset;
  if (border_.used) factorBorder(state, prior, equations);
}

// The disparity offset is last: x = Lambda^-1 g - Lambda^-1 border o.
void Solver::factorBorder(const State& state, const Prior& prior, const NormalEquations& equations) {
  solveFor(state, prior, equations, {prior.border, equations.border.pose, equations.border.landmark});
  border_.rows = rhs_;
  border_.landmark = landmark_step_;
  border_.caution = cautionFor(state);
  const double measured = prior.offset_information + equations.border.information;
  border_.calibration = prior.calibrationInformation(state.disparity_offset);
  border_.pivot = border_.calibration + std::max(measured - decrement_, 0.0) / border_.caution;
}

double Solver::offsetInformation() const {
  return border_.used ? (border_.pivot - border_.calibration) * border_.caution : 0.0;
}

double Solver::offsetPull(const Prior& prior, double offset) const {
  return border_.caution * prior.calibrationInformation(offset) * (prior.calibrated_offset - offset);
}

double Solver::dotBorder(const State& state, const Prior& prior, const NormalEquations& equations) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(prior.size()); ++i) sum += prior.border[i] * rhs_[i];
  for (std::size_t j = 0; j < poses_; ++j) sum += equations.border.pose[j].dot(poseStep(j));
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot)
    if (state.landmarks[slot].used && !state.landmarks[slot].known)
      sum += equations.border.landmark[slot].dot(landmark_step_[slot]);
  return sum;
}

void Solver::solve(const State& state, const Prior& prior, const NormalEquations& equations,
                   const std::vector<double>& prior_gradient, double prior_offset_gradient) {
  solveFor(state, prior, equations, {prior_gradient, equations.pose_gradient, equations.landmark_gradient});
  offset_step_ = 0.0;
  if (!border_.used) return;
  const double left = prior_offset_gradient + equations.border.gradient - dotBorder(state, prior, equations);
  const double pull = left / border_.caution + prior.calibrationInformation(state.disparity_offset) *
                                                   (prior.calibrated_offset - state.disparity_offset);
  offset_step_ = pull / border_.pivot;
  decrement_ += pull * offset_step_;
  for (std::size_t i = 0; i < rhs_.size(); ++i) rhs_[i] -= border_.rows[i] * offset_step_;
  for (std::size_t slot = 0; slot < landmark_step_.size(); ++slot)
    landmark_step_[slot] -= border_.landmark[slot] * offset_step_;
}

void Solver::solveFor(const State& state, const Prior& prior, const NormalEquations& equations,
                      const RightSide& right) {
  if (poses_first_) solvePosesFirst(state, prior, right);
  else solveLandmarksFirst(state, prior, equations, right);
}

void Solver::solvePosesFirst(const State& state, const Prior& prior, const RightSide& right) {
  path_.resize(6 * poses_);
  map_.assign(static_cast<std::size_t>(pose_elimination_.mapSize()), 0.0);
  for (std::size_t j = 0; j < poses_; ++j) Map<Vector6d>(path_.data() + 6 * j) = right.pose[j];
  std::copy(right.prior.begin(), right.prior.begin() + static_cast<std::ptrdiff_t>(offset_), map_.begin());
  if (prior.has_pose) Map<Vector6d>(path_.data()) += Map<const Vector6d>(right.prior.data() + offset_);
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot)
    if (pose_elimination_.toRow(slot) >= 0)
      Map<Vector3d>(map_.data() + pose_elimination_.toRow(slot)) += right.landmark[slot];
  right_path_ = path_;
  right_map_ = map_;
  pose_elimination_.solve(path_, map_, true);
  decrement_ = 0.0;
  for (std::size_t i = 0; i < path_.size(); ++i) decrement_ += path_[i] * right_path_[i];
  for (std::size_t i = 0; i < map_.size(); ++i) decrement_ += map_[i] * right_map_[i];
  rhs_.assign(offset_ + 6 * poses_, 0.0);
  std::copy(path_.begin(), path_.end(), rhs_.begin() + static_cast<std::ptrdiff_t>(offset_));
  landmark_step_.assign(state.landmarks.size(), Vector3d::Zero());
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot)
    if (pose_elimination_.toRow(slot) >= 0)
      landmark_step_[slot] = Map<const Vector3d>(map_.data() + pose_elimination_.toRow(slot));
}

void Solver::factorLandmarksFirst(const State& state, const Prior& prior, const NormalEquations& equations,
                                  bool datum) {
  const int size = static_cast<int>(offset_ + 6 * poses_);
  dense_.resize(size);
  for (std::vector<double>* some : {&floor_, &rhs_, &column_})
    reserveWithHeadroom(*some, static_cast<std::size_t>(size));
  floor_.assign(static_cast<std::size_t>(size), 1.0);
  // The prior's blocks are the first of this matrix, in the same order.
  for (int j = 0; j < size; ++j) {
    const int known = std::max(prior.size(), j);
    if (j < prior.size())
      std::copy(prior.information.column(j) + j, prior.information.column(j) + known, dense_.column(j) + j);
    std::fill(dense_.column(j) + known, dense_.column(j) + size, 0.0);
  }
  for (std::size_t i = 0; i < prior.slots.size(); ++i) {
    const std::size_t slot = static_cast<std::size_t>(prior.slots[i]);
    const int column = 3 * static_cast<int>(i);
    addBlock(dense_, column, column, equations.landmark[slot].data(), 3, 3);
    std::size_t cross = static_cast<std::size_t>(equations.first_cross[slot]);
    for (const Measurement& measurement : state.landmarks[slot].seen)
      addBlock(dense_, static_cast<int>(offset_) + 6 * static_cast<int>(measurement.step - state.first_step), column,
               equations.cross[cross++].data(), 6, 3);
  }
  for (std::size_t j = 0; j < poses_; ++j) {
    const int at = static_cast<int>(offset_ + 6 * j);
    addBlock(dense_, at, at, equations.pose[j].data(), 6, 6);
    if (j + 1 < poses_) addBlock(dense_, at + 6, at, equations.next[j].data(), 6, 6);
    for (int i = 0; i < 6; ++i) floor_[static_cast<std::size_t>(at + i)] = process_model::floor()(i, i);
  }
  if (datum)
    for (int i = static_cast<int>(offset_); i < static_cast<int>(offset_) + 6; ++i)
      dense_(i, i) += kDatumStrength * (1.0 + dense_(i, i));
  eliminateFree(state, equations);
  cholesky_.factor(dense_, floor_);
}

void Solver::solveLandmarksFirst(const State& state, const Prior& prior, const NormalEquations& equations,
                                 const RightSide& right) {
  rhs_.assign(offset_ + 6 * poses_, 0.0);
  std::copy(right.prior.begin(), right.prior.begin() + prior.size(), rhs_.begin());
  for (std::size_t i = 0; i < prior.slots.size(); ++i)
    Map<Vector3d>(rhs_.data() + 3 * i) += right.landmark[static_cast<std::size_t>(prior.slots[i])];
  for (std::size_t j = 0; j < poses_; ++j) Map<Vector6d>(rhs_.data() + offset_ + 6 * j) += right.pose[j];
  landmark_step_.assign(state.landmarks.size(), Vector3d::Zero());
  decrement_ = 0.0;
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state.landmarks[slot];
    if (!isFree(landmark) || landmark.seen.empty()) continue;
    const Vector3d y = inverse_root_[slot] * right.landmark[slot];
    landmark_step_[slot] = y;
    decrement_ += y.squaredNorm();
    std::size_t m = static_cast<std::size_t>(equations.first_cross[slot]);
    for (const Measurement& measurement : landmark.seen)
      Map<Vector6d>(rhs_.data() + offset_ + 6 * static_cast<std::size_t>(measurement.step - state.first_step)) -=
          eliminated_[m++] * y;
  }
  cholesky_.solveLower(rhs_.data());
  cholesky_.release(rhs_.data());
  for (const double value : rhs_) decrement_ += value * value;
  cholesky_.solveUpper(rhs_.data());
  cholesky_.release(rhs_.data());
  for (std::size_t i = 0; i < prior.slots.size(); ++i)
    landmark_step_[static_cast<std::size_t>(prior.slots[i])] = Map<const Vector3d>(rhs_.data() + 3 * i);
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state.landmarks[slot];
    if (!isFree(landmark) || landmark.seen.empty()) continue;
    Vector3d y = landmark_step_[slot];
    std::size_t m = static_cast<std::size_t>(equations.first_cross[slot]);
    for (const Measurement& measurement : landmark.seen)
      y.noalias() -=
          eliminated_[m++].transpose() * poseStep(static_cast<std::size_t>(measurement.step - state.first_step));
    landmark_step_[slot] = inverse_root_[slot].transpose() * y;
  }
}

Vector6d Solver::poseStep(std::size_t j) const { return Map<const Vector6d>(rhs_.data() + offset_ + 6 * j); }

const std::vector<double>& Solver::inverseColumn(std::size_t j, int c, bool poses_only) const {
  column_.assign(offset_ + 6 * poses_, 0.0);
  if (poses_first_) {
    path_.assign(6 * poses_, 0.0);
    map_.assign(static_cast<std::size_t>(pose_elimination_.mapSize()), 0.0);
    path_[6 * j + static_cast<std::size_t>(c)] = 1.0;
    pose_elimination_.solve(path_, map_, false);
    std::copy(map_.begin(), map_.begin() + static_cast<std::ptrdiff_t>(offset_), column_.begin());
    std::copy(path_.begin(), path_.end(), column_.begin() + static_cast<std::ptrdiff_t>(offset_));
    return column_;
  }
  const std::size_t at = toRow(j) + static_cast<std::size_t>(c);
  column_[at] = 1.0;
  cholesky_.solveLower(column_.data(), static_cast<int>(at));
  cholesky_.solveUpper(column_.data(), poses_only ? static_cast<int>(offset_) : 0);
  return column_;
}

const std::vector<double>& Solver::inverseColumns(std::size_t j) const {
  const std::size_t size = offset_ + 6 * poses_;
  reserveWithHeadroom(columns_of_pose_, 6 * size);
  columns_of_pose_.assign(6 * size, 0.0);
  for (std::size_t c = 0; c < 6; ++c) {
    double* column = columns_of_pose_.data() + c * size;
    if (poses_first_) {
      const std::vector<double>& one = inverseColumn(j, static_cast<int>(c), false);
      std::copy(one.begin(), one.end(), column);
      continue;
    }
    column[toRow(j) + c] = 1.0;
    cholesky_.solveLower(column, static_cast<int>(toRow(j) + c));
  }
  if (!poses_first_) cholesky_.solveUpperSix(columns_of_pose_.data(), static_cast<int>(size));
  return columns_of_pose_;
}

void Solver::archive(urban_nav_core::Archive& archive) {
  archive(poses_, offset_, poses_first_, border_.used, border_.rows, border_.pivot, border_.calibration,
          border_.caution);
  const std::size_t rows = offset_ + 6 * poses_;
  archive.require(poses_ < kMostRows && offset_ < kMostRows && (!border_.used || border_.rows.size() == rows),
                  "invalid size of a factor");
  if (poses_ == 0) return;
  if (poses_first_) archive(pose_elimination_);
  else cholesky_.archive(archive, dense_);
  archive.require(poses_first_ ? pose_elimination_.poses() == poses_ &&
                                     static_cast<std::size_t>(pose_elimination_.mapSize()) >= offset_
                               : static_cast<std::size_t>(dense_.size()) == rows,
                  "invalid size of a factor");
}

}  // namespace swf_vo
