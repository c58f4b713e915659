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

/// What the pose that left last owes to what is still there.
struct Departed {
  /// d(it)/d(blocks of the prior), 6 columns to a row of the prior, column-major with prior.size() rows: -Lambda_a^-1
  /// Lambda_b, transposed.
  std::vector<double> gain;
  urban_nav_core::Vector6d offset_gain = urban_nav_core::Vector6d::Zero();  ///< d(it)/d(disparity offset)
  /// `gain` times the directions of the gauge (gauge.hpp): how it goes with the rest of the window.
  urban_nav_core::Matrix6d gauge_gain = urban_nav_core::Matrix6d::Zero();
  /// G^T Lambda G before less G^T Lambda G after: the information on where the window stands that went with it, Lambda
  /// taken of the prior and of the terms that went in.
  urban_nav_core::Matrix6d gauge_loss = urban_nav_core::Matrix6d::Zero();
};

void archive(urban_nav_core::Archive& archive, Departed& departed);

/// The only place where information leaves x: the oldest pose, and landmarks that no active pose sees and nothing
/// follows, go into the prior by the Schur complement Lambda_c - Lambda_b^T Lambda_a^-1 Lambda_b (Newman et al. 2009,
/// section 2.2), never by deletion. Whatever Lambda_a does not determine is left out of the inverse: there is nothing
/// to hand on. Derivation: docs/derivations/sliding_window_filter.md.
class Marginaliser {
 public:
  /// Takes poses.front() out of `state` with its measurements; the pose after it and the landmarks it saw are then
  /// tied by the prior. Needs a second pose. The linearisation points must be those of Cost::relinearise. Directions of
  /// the gauge are about `origin`. `history` and `scores` may be null.
  void removeOldest(State& state, Prior& prior, const Cost& cost, const Eigen::Vector3d& origin, History* history,
                    LandmarkScores* scores);

  /// About the pose that left; what happens to the prior before the next one is added to it.
  Departed& departed() { return departed_; }
  const Departed& departed() const { return departed_; }
  /// Slots of the landmarks that left with it and that the prior had known.
  const std::vector<int>& dying() const { return dying_; }

 private:
  struct Block {
    int at, size;
  };
  struct Run {
    int from, to, size;  // rows of the prior, of what dies or of what is kept
    bool dies;
  };

  void sort(const State& state, const Prior& prior);
  void findRuns(const Prior& prior);
  void gatherPrior(const Prior& prior, const State& state);
  void addTerms(const State& state, const Cost& cost, LandmarkScores* scores);
  void gatherGauge(const State& state, const Eigen::Vector3d& origin);
  void eliminate();
  /// Computes what the departed poses gain from those that remain.
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
  std::vector<int> place_;         // by slot: kept: 3 i; dying: -1 - 3 i; neither: unused
  std::vector<Run> runs_;
  int eliminated_ = 0, remaining_ = 0;  // sizes: e and n
  int stride_ = 0;
  std::vector<double> panel_;  // (e + n) x e: Lambda_a over Lambda_b^T; then its factors
  StripProduct product_;
  DenseMatrix reduced_;           // n x n
  std::vector<double> gradient_;  // e + n
  std::vector<double> border_;    // e + n: the disparity offset's, eliminated like a gradient
  double offset_information_ = 0.0, offset_gradient_ = 0.0;
  std::vector<double> d_, g_;
  std::vector<Block> blocks_;                    // of the eliminated, in order
  std::vector<urban_nav_core::Matrix6d> roots_;  // of each: G with G G^T = the (pseudo-)inverse of its pivot
  Departed departed_;
  std::vector<double> times_root_;
  std::vector<double> directions_;               // G, (e + n) x 6
  std::vector<urban_nav_core::Vector6d> gauge_;  // rows of Lambda G, of the eliminated
  std::vector<Eigen::Vector3d> centres_;
};

}  // namespace swf_vo
