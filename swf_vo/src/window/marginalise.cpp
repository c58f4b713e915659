// SPDX-License-Identifier: BSD-3-Clause
#include "window/marginalise.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "window/gauge.hpp"
#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

// Eigenvalues of a block scaled to unit diagonal below this are rounding errors.
constexpr double kLeastEigenvalue = 1e-12;
constexpr int kUnused = 1 << 30;

// G with G G^T = D^-1, or the pseudo-inverse for singular D.
template <int N>
Eigen::Matrix<double, N, N> inverseRoot(const Eigen::Matrix<double, N, N>& D) {
  Eigen::Matrix<double, N, 1> scale;
  for (int i = 0; i < N; ++i) scale[i] = D(i, i) > 0.0 ? 1.0 / std::sqrt(D(i, i)) : 0.0;
  const Eigen::Matrix<double, N, N> scaled = scale.asDiagonal() * D * scale.asDiagonal();
  const auto eigen = urban_nav_core::smallEigen<N>(scaled);
  Eigen::Matrix<double, N, 1> roots;
  for (int i = 0; i < N; ++i) roots[i] = eigen.values[i] > kLeastEigenvalue ? 1.0 / std::sqrt(eigen.values[i]) : 0.0;
  return scale.asDiagonal() * eigen.vectors * roots.asDiagonal();
}

bool seenBy(const LandmarkBlock& landmark, std::int64_t step) {
  return !landmark.seen.empty() && landmark.seen.front().step == step;
}

bool staysWithout(const LandmarkBlock& landmark, std::int64_t step) {
  return landmark.followed || landmark.seen.size() > (seenBy(landmark, step) ? 1U : 0U);
}

template <typename Block>
void add(double* column, int stride, const Block& block) {
  Eigen::Map<Block, 0, Eigen::OuterStride<>>(column, block.rows(), block.cols(), Eigen::OuterStride<>(stride)) += block;
}

}  // namespace

void Marginaliser::sort(const State& state, const Prior& prior) {
  kept_.clear();
  dying_.clear();
  for (std::vector<int>* slots : {&kept_, &dying_}) slots->reserve(state.landmarks.size());
  centres_.reserve(state.landmarks.size());
  place_.assign(state.landmarks.size(), kUnused);
  for (const int slot : prior.slots) {
    const std::size_t at = static_cast<std::size_t>(slot);
    if (staysWithout(state.landmarks[at], state.first_step)) {
      place_[at] = 3 * static_cast<int>(kept_.size());
      kept_.push_back(slot);
    } else {
      place_[at] = -1 - 3 * static_cast<int>(dying_.size());
      dying_.push_back(slot);
    }
  }
  for (std::size_t at = 0; at < state.landmarks.size(); ++at) {
    const LandmarkBlock& landmark = state.landmarks[at];
    // A landmark observed only by this pose and not tracked absorbs its measurement: it adds no information.
    if (!landmark.used || landmark.known || landmark.prior >= 0 || !seenBy(landmark, state.first_step)) continue;
    if (!staysWithout(landmark, state.first_step)) continue;
    place_[at] = 3 * static_cast<int>(kept_.size());
    kept_.push_back(static_cast<int>(at));
  }
  eliminated_ = 3 * static_cast<int>(dying_.size()) + 6;
  remaining_ = 3 * static_cast<int>(kept_.size()) + 6;
  stride_ = eliminated_ + remaining_;
  blocks_.clear();
  blocks_.reserve(state.landmarks.size() + 1);
  for (int i = 0; i < static_cast<int>(dying_.size()); ++i) blocks_.push_back({3 * i, 3});
  blocks_.push_back({eliminated_ - 6, 6});
}

// Blocks that remain adjacent, in the order of the prior; its pose is the last of the eliminated ones.
void Marginaliser::findRuns(const Prior& prior) {
  runs_.clear();
  runs_.reserve(prior.slots.capacity() + 1);
  const auto add = [&](int from, int to, int size, bool dies) {
    if (!runs_.empty() && runs_.back().dies == dies && runs_.back().to + runs_.back().size == to)
      runs_.back().size += size;
    else runs_.push_back({from, to, size, dies});
  };
  for (std::size_t i = 0; i < prior.slots.size(); ++i) {
    const int place = place_[static_cast<std::size_t>(prior.slots[i])];
    add(3 * static_cast<int>(i), place >= 0 ? place : -1 - place, 3, place < 0);
  }
  add(prior.landmarkSize(), eliminated_ - 6, 6, true);
}

void Marginaliser::gatherPrior(const Prior& prior, const State& state) {
  const std::size_t size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(eliminated_);
  reserveWithHeadroom(panel_, size);
  panel_.resize(size);
  reduced_.resize(remaining_);
  for (std::vector<double>* some : {&gradient_, &border_, &d_, &g_})
    reserveWithHeadroom(*some, static_cast<std::size_t>(stride_));
  gradient_.assign(static_cast<std::size_t>(stride_), 0.0);
  border_.assign(static_cast<std::size_t>(stride_), 0.0);
  offset_information_ = prior.offset_information;
  offset_gradient_ = 0.0;
  // Entries outside the prior are zero; the others are overwritten.
  const int touched = prior.has_pose ? prior.landmarkSize() - (eliminated_ - 6) : 0;
  for (int j = 0; j < eliminated_; ++j)
    std::fill(eliminatedColumn(j) + (prior.has_pose ? eliminated_ + touched : 0), eliminatedColumn(j) + stride_, 0.0);
  for (int j = 0; j < remaining_; ++j)
    std::fill(reduced_.column(j) + std::max(j, touched), reduced_.column(j) + remaining_, 0.0);
  if (!prior.has_pose) return;
  prior.deviation(state, d_);
  prior.gradient(d_, state.disparity_offset, g_, offset_gradient_);
  findRuns(prior);
  for (const Run& columns : runs_)
    for (int c = 0; c < columns.size; ++c) {
      const int j = columns.from + c, to_j = columns.to + c;
      const double* from = prior.information.column(j);
      double* to = columns.dies ? eliminatedColumn(to_j) : reduced_.column(to_j);
      const std::size_t row = static_cast<std::size_t>(columns.dies ? to_j : eliminated_ + to_j);
      gradient_[row] = g_[static_cast<std::size_t>(j)];
      border_[row] = prior.border[static_cast<std::size_t>(j)];
      for (const Run& rows : runs_) {
        const int first = std::max(rows.from, j), last = rows.from + rows.size, at = rows.to + first - rows.from;
        if (first >= last) continue;
        if (columns.dies) std::copy(from + first, from + last, to + (rows.dies ? at : eliminated_ + at));
        else if (!rows.dies) std::copy(from + first, from + last, to + at);
        else
          for (int i = first; i < last; ++i) eliminatedColumn(at + i - first)[eliminated_ + to_j] = from[i];
      }
    }
}

void Marginaliser::addTerms(const State& state, const Cost& cost, LandmarkScores* scores) {
  const PoseBlock& oldest = state.poses[0];
  const int pose = eliminated_ - 6;
  for (std::size_t at = 0; at < state.landmarks.size(); ++at) {
    const LandmarkBlock& landmark = state.landmarks[at];
    if (!landmark.used || !seenBy(landmark, state.first_step)) continue;
    if (!landmark.known && place_[at] == kUnused) continue;
    const SensorTerm term = cost.sensorTerm(state, landmark, landmark.seen.front(), oldest);
    add(eliminatedColumn(pose) + pose, stride_, term.pose);
    Map<Vector6d>(gradient_.data() + pose) += term.pose_gradient;
    Map<Vector6d>(border_.data() + pose) += term.pose_border;
    offset_information_ += term.border_information;
    offset_gradient_ += term.border_gradient;
    if (landmark.known) continue;
    if (scores != nullptr) scores->add(at, landmark, oldest, term);
    if (place_[at] >= 0) {
      const int row = place_[at];
      add(eliminatedColumn(pose) + eliminated_ + row, stride_, Eigen::Matrix<double, 3, 6>(term.cross.transpose()));
      add(reduced_.column(row) + row, reduced_.stride(), term.landmark);
      Map<Vector3d>(gradient_.data() + eliminated_ + row) += term.landmark_gradient;
      Map<Vector3d>(border_.data() + eliminated_ + row) += term.landmark_border;
    } else {
      const int column = -1 - place_[at];
      add(eliminatedColumn(column) + pose, stride_, term.cross);
      add(eliminatedColumn(column) + column, stride_, term.landmark);
      Map<Vector3d>(gradient_.data() + column) += term.landmark_gradient;
      Map<Vector3d>(border_.data() + column) += term.landmark_border;
    }
  }
  const ProcessTerm term = cost.processTerm(oldest, state.poses[1]);
  add(eliminatedColumn(pose) + pose, stride_, term.last);
  add(eliminatedColumn(pose) + eliminated_ + remaining_ - 6, stride_, term.cross);
  add(reduced_.column(remaining_ - 6) + remaining_ - 6, reduced_.stride(), term.next);
  Map<Vector6d>(gradient_.data() + pose) += term.last_gradient;
  Map<Vector6d>(gradient_.data() + eliminated_ + remaining_ - 6) += term.next_gradient;
}

// Lambda G at the eliminated rows: their information on the gauge.
void Marginaliser::gatherGauge(const State& state, const Vector3d& origin) {
  const std::size_t stride = static_cast<std::size_t>(stride_);
  reserveWithHeadroom(directions_, 6 * stride);
  directions_.resize(6 * stride);
  const auto put = [&](int row, const auto& G) {
    for (std::size_t k = 0; k < 6; ++k)
      for (int r = 0; r < G.rows(); ++r)
        directions_[k * stride + static_cast<std::size_t>(row + r)] = G(r, static_cast<Eigen::Index>(k));
  };
  const auto putLandmarks = [&](const std::vector<int>& slots, int row) {
    for (const int slot : slots) {
      const LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(slot)];
      put(row, gauge::ofLandmark(landmark.anchor, landmark.linearised, origin));
      row += 3;
    }
  };
  putLandmarks(dying_, 0);
  put(eliminated_ - 6, gauge::ofPose(state.poses[0].linearised, origin));
  putLandmarks(kept_, eliminated_);
  put(stride_ - 6, gauge::ofPose(state.poses[1].linearised, origin));
  reserveWithHeadroom(gauge_, static_cast<std::size_t>(eliminated_));
  gauge_.resize(static_cast<std::size_t>(eliminated_));
  for (int j = 0; j < eliminated_; ++j) {
    double* column = eliminatedColumn(j);
    for (int i = 0; i < j; ++i) column[i] = eliminatedColumn(i)[j];
    for (std::size_t k = 0; k < 6; ++k)
      gauge_[static_cast<std::size_t>(j)][static_cast<Eigen::Index>(k)] =
          kernels::dot(column, directions_.data() + k * stride, stride_);
  }
}

void Marginaliser::timesRoot(const Block& block, const Matrix6d& G) {
  const int below = block.at + block.size, rows = stride_ - below;
  reserveWithHeadroom(times_root_, static_cast<std::size_t>(rows) * 6);
  times_root_.resize(static_cast<std::size_t>(rows) * 6);
  for (int c = 0; c < block.size; ++c)
    std::copy_n(eliminatedColumn(block.at + c) + below, rows,
                times_root_.data() + static_cast<std::size_t>(c) * static_cast<std::size_t>(rows));
  for (int c = 0; c < block.size; ++c) {
    double* column = eliminatedColumn(block.at + c) + below;
    std::fill_n(column, rows, 0.0);
    for (int r = 0; r < block.size; r += 3) {
      const double* X = times_root_.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(rows);
      const double factors[3] = {-G(r, c), -G(r + 1, c), -G(r + 2, c)};
      kernels::subtractThree(column, X, X + rows, X + 2 * rows, factors, rows);
    }
  }
}

void Marginaliser::eliminate() {
  reserveWithHeadroom(roots_, blocks_.size());
  roots_.assign(blocks_.size(), Matrix6d::Zero());
  departed_.gauge_loss.setZero();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block block = blocks_[b];
    const int below = block.at + block.size;
    Matrix6d D = Matrix6d::Zero();
    for (int c = 0; c < block.size; ++c)
      for (int r = c; r < block.size; ++r) D(r, c) = D(c, r) = eliminatedColumn(block.at + c)[block.at + r];
    Matrix6d& G = roots_[b];
    if (block.size == 6) G = inverseRoot<6>(D);
    else G.topLeftCorner<3, 3>() = inverseRoot<3>(D.topLeftCorner<3, 3>());
    // F = Lambda_b^T G in place, then its update of the following blocks.
    timesRoot(block, G);
    Vector6d y = Vector6d::Zero(), tied = Vector6d::Zero();
    for (int c = 0; c < block.size; ++c) {
      y[c] = G.col(c).head(block.size).dot(Map<const Eigen::VectorXd>(gradient_.data() + block.at, block.size));
      tied[c] = G.col(c).head(block.size).dot(Map<const Eigen::VectorXd>(border_.data() + block.at, block.size));
    }
    offset_information_ -= tied.squaredNorm();
    offset_gradient_ -= tied.dot(y);
    for (int c = 0; c < block.size; c += 3) {
      const double *F0 = eliminatedColumn(block.at + c), *F1 = eliminatedColumn(block.at + c + 1),
                   *F2 = eliminatedColumn(block.at + c + 2);
      kernels::subtractThree(gradient_.data() + below, F0 + below, F1 + below, F2 + below, y.data() + c,
                             stride_ - below);
      kernels::subtractThree(border_.data() + below, F0 + below, F1 + below, F2 + below, tied.data() + c,
                             stride_ - below);
      for (int j = below; j < eliminated_; ++j) {
        const double factors[3] = {F0[j], F1[j], F2[j]};
        kernels::subtractThree(eliminatedColumn(j) + j, F0 + j, F1 + j, F2 + j, factors, stride_ - j);
      }
      for (int k = c; k < c + 3; ++k) {
        const double* F = eliminatedColumn(block.at + k);
        Vector6d held = Vector6d::Zero();
        for (int r = 0; r < block.size; ++r) held += G(r, k) * gauge_[static_cast<std::size_t>(block.at + r)];
        departed_.gauge_loss.noalias() += held * held.transpose();
        for (int j = below; j < eliminated_; ++j) gauge_[static_cast<std::size_t>(j)] -= F[j] * held;
      }
    }
    for (int c = 0; c < block.size; ++c) {
      gradient_[static_cast<std::size_t>(block.at + c)] = y[c];
      border_[static_cast<std::size_t>(block.at + c)] = tied[c];
    }
  }
  product_.subtract(reduced_, 0, remaining_, panel_.data() + eliminated_, eliminated_, stride_);
  computeGain();
}

void Marginaliser::computeGain() {
  // d_pose = G (y - F^T d - b o): the transposed gain is -F G^T.
  reserveWithHeadroom(departed_.gain, static_cast<std::size_t>(6 * remaining_));
  departed_.gain.assign(static_cast<std::size_t>(6 * remaining_), 0.0);
  const Matrix6d& G = roots_.back();
  departed_.offset_gain = -(G * Map<const Vector6d>(border_.data() + eliminated_ - 6));
  for (int c = 0; c < 6; ++c) {
    const double* F = eliminatedColumn(eliminated_ - 6 + c) + eliminated_;
    for (int r = 0; r < 6; ++r)
      for (int i = 0; i < remaining_; ++i)
        departed_.gain[static_cast<std::size_t>(r * remaining_ + i)] -= F[i] * G(r, c);
  }
  for (int r = 0; r < 6; ++r)
    for (int k = 0; k < 6; ++k)
      departed_.gauge_gain(r, k) = kernels::dot(departed_.gain.data() + r * remaining_,
                                                directions_.data() + k * stride_ + eliminated_, remaining_);
}

void Marginaliser::record(const State& state, History& history) const {
  const auto tieTo = [&](int slot) {
    const LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(slot)];
    History::Row::Tie tie;
    tie.id = landmark.id;
    tie.landmark = landmark.estimate;
    return tie;
  };
  const auto tieToPose = [&](const PoseBlock& pose) {
    History::Row::Tie tie;
    tie.is_pose = true;
    tie.id = pose.frame;
    tie.pose = pose.estimate;
    return tie;
  };
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block block = blocks_[b];
    History::Row row;
    row.is_pose = block.size == 6;
    if (row.is_pose) {
      row.id = state.poses[0].frame;
      row.pose = state.poses[0].estimate;
      row.linearised_pose = state.poses[0].linearised;
    } else {
      const LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(dying_[b])];
      row.id = landmark.id;
      row.landmark = landmark.estimate;
      row.linearised_landmark = landmark.linearised;
      row.anchor = landmark.anchor;
    }
    for (std::size_t later = b + 1; later < dying_.size(); ++later) row.ties.push_back(tieTo(dying_[later]));
    if (!row.is_pose) row.ties.push_back(tieToPose(state.poses[0]));
    for (const int slot : kept_) row.ties.push_back(tieTo(slot));
    row.ties.push_back(tieToPose(state.poses[1]));
    const Eigen::MatrixXd G = roots_[b].topLeftCorner(block.size, block.size);
    row.offset.resize(static_cast<std::size_t>(block.size));
    Map<Eigen::VectorXd>(row.offset.data(), block.size) =
        G * Map<const Eigen::VectorXd>(gradient_.data() + block.at, block.size);
    row.disparity_offset = state.disparity_offset;
    row.disparity_gain.resize(static_cast<std::size_t>(block.size));
    Map<Eigen::VectorXd>(row.disparity_gain.data(), block.size) =
        -(G * Map<const Eigen::VectorXd>(border_.data() + block.at, block.size));
    for (int i = block.at + block.size; i < stride_; ++i) {
      Eigen::VectorXd F(block.size);
      for (int c = 0; c < block.size; ++c) F[c] = eliminatedColumn(block.at + c)[i];
      const Eigen::VectorXd column = -(G * F);
      row.gain.insert(row.gain.end(), column.data(), column.data() + block.size);
    }
    history.rows.push_back(std::move(row));
  }
}

void Marginaliser::keep(State& state, Prior& prior) {
  std::swap(prior.information, reduced_);
  centres_.clear();
  for (const int slot : kept_) {
    const LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(slot)];
    centres_.push_back(landmark.prior >= 0 ? prior.landmark_centre[static_cast<std::size_t>(landmark.prior)]
                                           : landmark.estimate);
  }
  prior.landmark_centre.swap(centres_);
  prior.slots.swap(kept_);
  prior.pose_centre = state.poses[1].estimate;
  prior.has_pose = prior.frozen = true;
  for (const int slot : dying_) state.landmarks[static_cast<std::size_t>(slot)].prior = -1;
  for (std::size_t i = 0; i < prior.slots.size(); ++i)
    state.landmarks[static_cast<std::size_t>(prior.slots[i])].prior = static_cast<int>(i);

  const std::int64_t leaving = state.first_step;
  for (std::size_t at = 0; at < state.landmarks.size(); ++at) {
    LandmarkBlock& landmark = state.landmarks[at];
    if (!landmark.used) continue;
    if (seenBy(landmark, leaving)) landmark.seen.erase(landmark.seen.begin());
    if (!landmark.followed && landmark.seen.empty()) state.remove(static_cast<int>(at));
  }
  state.poses.erase(state.poses.begin());
  ++state.first_step;

  // The gradient is at the estimates, eta at the centre: g + Pi d + border o, which is gradient() of (-d, -o).
  reserveWithHeadroom(prior.eta, static_cast<std::size_t>(remaining_));
  reserveWithHeadroom(prior.border, static_cast<std::size_t>(remaining_));
  prior.eta.assign(gradient_.begin() + eliminated_, gradient_.begin() + stride_);
  prior.border.assign(border_.begin() + eliminated_, border_.begin() + stride_);
  prior.offset_information = prior.has_offset ? offset_information_ : 0.0;
  prior.offset_eta = offset_gradient_;
  prior.deviation(state, d_);
  for (double& value : d_) value = -value;
  double eta_offset = 0.0;
  prior.gradient(d_, -state.disparity_offset, g_, eta_offset);
  prior.eta.swap(g_);
  prior.offset_eta = eta_offset;
}

void Marginaliser::removeOldest(State& state, Prior& prior, const Cost& cost, const Vector3d& origin, History* history,
                                LandmarkScores* scores) {
  sort(state, prior);
  gatherPrior(prior, state);
  addTerms(state, cost, scores);
  gatherGauge(state, origin);
  eliminate();
  if (history != nullptr) record(state, *history);
  keep(state, prior);
}

void archive(urban_nav_core::Archive& archive, Departed& departed) {
  archive(departed.gain, departed.offset_gain, departed.gauge_gain, departed.gauge_loss);
  archive.require(departed.gain.size() % 6 == 0, "gain does not have six columns");
}

}  // namespace swf_vo
