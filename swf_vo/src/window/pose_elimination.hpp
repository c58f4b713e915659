// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/cost.hpp"
#include "window/dense_cholesky.hpp"
#include "window/prior.hpp"

namespace swf_vo {

/// Solves Lambda d = g by eliminating poses first (Newman et al. 2009, section 2.1, path-onto-map). Poses form a chain,
/// each coupled to the next by its process term, so eliminating k of them takes k small steps; the remainder is a dense
/// system of all landmarks. Cheaper than landmarks first for few landmarks and many poses.
class PoseElimination {
 public:
  /// Returns the number of operations (multiply and add) of a factorisation.
  static double operations(std::size_t poses, std::size_t landmarks);

  void factor(const State& state, const Prior& prior, const NormalEquations& equations, double datum_strength);

  /// Solves in place: `path` holds 6 elements per pose, `map` 3 per landmark, those of the prior first, then by slot.
  /// `hold`: undetermined components are unchanged (steps); else their information is process_model::floor()
  /// (covariances).
  void solve(std::vector<double>& path, std::vector<double>& map, bool hold) const;

  /// Row of a landmark in `map`, by slot.
  int toRow(std::size_t slot) const { return row_[slot]; }
  int mapSize() const { return map_size_; }
  std::size_t poses() const { return links_.size(); }
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Link {
    urban_nav_core::Matrix6d L;     ///< Cholesky factor of this pose
    urban_nav_core::Matrix6d next;  ///< rows of the next pose, multiplied by L^-T
    bool held[6];
  };

  void gather(const State& state, const Prior& prior, const NormalEquations& equations);
  void factorPose(std::size_t j, const urban_nav_core::Vector6d& diagonal);
  double* across(std::size_t column) { return across_.data() + column * stride_; }
  const double* across(std::size_t column) const { return across_.data() + column * stride_; }

  std::vector<Link> links_;
  std::vector<urban_nav_core::Matrix6d> pivots_;
  std::vector<int> row_;
  std::vector<double> across_;  // landmarks x poses, column-major: Lambda_mp, then multiplied by L^-T
  std::vector<double> floor_;
  std::size_t stride_ = 0;
  int map_size_ = 0;
  DenseMatrix dense_;
  StripProduct product_;
  DenseCholesky cholesky_;
};

}  // namespace swf_vo
