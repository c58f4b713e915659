// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/cost.hpp"
#include "window/history.hpp"
#include "window/landmark_scores.hpp"
#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Cross terms of the last marginalised pose with the remaining states.
struct Departed {
  /// d(pose)/d(blocks of the prior), 6 columns for each row of the prior, column-major with prior.size() rows:
  /// -Lambda_a^-1 Lambda_b, transposed.
  std::vector<double> gain;
  urban_nav_core::Vector6d offset_gain = urban_nav_core::Vector6d::Zero();  ///< d(pose)/d(disparity offset)
  /// `gain` times the gauge directions (gauge.hpp): motion of the pose with the rest of the window.
  urban_nav_core::Matrix6d gauge_gain = urban_nav_core::Matrix6d::Zero();
  /// G^T Lambda G before minus G^T Lambda G after: loss of information on the pose of the window in `odom`, with Lambda
  /// of the prior and of the marginalised terms.
  urban_nav_core::Matrix6d gauge_loss = urban_nav_core::Matrix6d::Zero();
};

void archive(urban_nav_core::Archive& archive, Departed& departed);

/// Marginalises the oldest pose, and landmarks that have no measurement in an active pose and are not tracked, into the
/// prior by the Schur complement Lambda_c - Lambda_b^T Lambda_a^-1 Lambda_b (Newman et al. 2009, section 2.2).
/// Information leaves x nowhere else, and never by deletion. Directions that Lambda_a does not determine are left out
/// of the inverse: they carry no information. Derivation: docs/derivations/sliding_window_filter.md.
class Marginaliser {
 public:
  /// Removes poses.front() from `state` with its measurements; the next pose and the landmarks that it observed are
  /// then coupled by the prior. Requires a second pose, and the linearisation points of Cost::relinearise. Gauge
  /// directions are about `origin`. `history` and `scores` may be null.
  void removeOldest(State& state, Prior& prior, const Cost& cost, const Eigen::Vector3d& origin, History* history,
                    LandmarkScores* scores);

  /// Cross terms of the marginalised pose; changes of the prior before the next marginalisation are to be applied to
  /// them.
  Departed& departed() { return departed_; }
  const Departed& departed() const { return departed_; }
  /// Slots of the landmarks marginalised with it that were in the prior.
  const std::vector<int>& dying() const { return dying_; }

 private:
  struct Block {
    int at, size;
  };
  struct Run {
    int from, to, size;  // rows of the prior, of the eliminated or of the remaining blocks
    bool dies;
  };

  void sort(const State& state, const Prior& prior);
  void findRuns(const Prior& prior);
  void gatherPrior(const Prior& prior, const State& state);
  void addTerms(const State& state, const Cost& cost, LandmarkScores* scores);
  void gatherGauge(const State& state, const Eigen::Vector3d& origin);
  void eliminate();
  /// Computes the gain of the marginalised pose with respect to the remaining blocks.
  void computeGain();
  void timesRoot(const Block& block, const urban_nav_core::Matrix6d& G);
  void record(const State& state, History& history) const;
  void keep(State& state, Prior& prior);

  double* eliminatedColumn(int j) {
    return panel_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_);
  }
  const double* eliminatedColumn(int j) const {
    return panel_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_);
  }

  std::vector<int> kept_, dying_;  // slots
  std::vector<int> place_;         // index by slot: remaining: 3 i; eliminated: -1 - 3 i; neither: unused
  std::vector<Run> runs_;
  int eliminated_ = 0, remaining_ = 0;  // sizes: e and n
  int stride_ = 0;
  std::vector<double> panel_;  // (e + n) x e: Lambda_a above Lambda_b^T; then its factors
  StripProduct product_;
  DenseMatrix reduced_;           // n x n
  std::vector<double> gradient_;  // e + n
  std::vector<double> border_;    // e + n: of the disparity offset, eliminated like a gradient
  double offset_information_ = 0.0, offset_gradient_ = 0.0;
  std::vector<double> d_, g_;
  std::vector<Block> blocks_;                    // eliminated ones, in order
  std::vector<urban_nav_core::Matrix6d> roots_;  // G with G G^T = (pseudo-)inverse of the pivot, for each block
  Departed departed_;
  std::vector<double> times_root_;
  std::vector<double> directions_;               // G, (e + n) x 6
  std::vector<urban_nav_core::Vector6d> gauge_;  // rows of Lambda G of the eliminated blocks
  std::vector<Eigen::Vector3d> centres_;
};

}  // namespace swf_vo
