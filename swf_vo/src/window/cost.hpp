// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo {

using Matrix63d = Eigen::Matrix<double, 6, 3>;

/// Row and column of the disparity offset in Lambda. It is coupled to all measurements in the right image, so it is
/// ordered and eliminated last.
struct Border {
  std::vector<urban_nav_core::Vector6d> pose;  ///< Lambda(p(j), offset)
  std::vector<Eigen::Vector3d> landmark;       ///< Lambda(m(i), offset), by slot
  double information = 0.0, gradient = 0.0;
};

/// Lambda and g of eq. 3 without the prior, by blocks: Lambda d = g (Newman et al. 2009, section 2.1). Derivation:
/// docs/derivations/sliding_window_filter.md.
struct NormalEquations {
  std::vector<urban_nav_core::Matrix6d> pose;           ///< Lambda_p(j, j)
  std::vector<urban_nav_core::Matrix6d> next;           ///< Lambda_p(j + 1, j)
  std::vector<urban_nav_core::Vector6d> pose_gradient;  ///< g_p(j)
  std::vector<Eigen::Matrix3d> landmark;                ///< Lambda_m(i, i), by slot
  std::vector<Eigen::Vector3d> landmark_gradient;       ///< g_m(i), by slot
  std::vector<Matrix63d> cross;                         ///< Lambda_pm(j, i), by slot and then by pose
  std::vector<int> first_cross;                         ///< index in `cross` by slot; landmarks of known position have
                                                        ///< no entry
  Border border;                                        ///< row of the disparity offset
  double cost = 0.0;                                    ///< robust cost of sensor and process terms
};

/// Contribution of one sensor term to Lambda and g, linearised.
struct SensorTerm {
  urban_nav_core::Matrix6d pose;
  Matrix63d cross;
  Eigen::Matrix3d landmark;
  urban_nav_core::Vector6d pose_gradient, pose_border;
  Eigen::Vector3d landmark_gradient, landmark_border;
  double border_information = 0.0, border_gradient = 0.0;  ///< terms of the disparity offset
};

/// Contribution of one process term: blocks of the earlier (last) and the later (next) pose.
struct ProcessTerm {
  urban_nav_core::Matrix6d last, cross, next;  ///< cross: rows of next, columns of last
  urban_nav_core::Vector6d last_gradient, next_gradient;
};

/// l(x) = process + sensor (Newman et al. 2009, eq. 3), with the Huber kernel on the Mahalanobis distance of a stereo
/// pixel.
class Cost {
 public:
  Cost(const SensorModel& sensor, double huber, bool linearise_first)
      : sensor_(sensor), huber_(huber), linearise_first_(linearise_first) {}

  /// Sets the linearisation points: the estimates, except for blocks of the prior (prior.hpp).
  void relinearise(State& state, const Prior& prior) const;

  /// Builds Lambda and g at the linearisation points, with residuals and weights at the estimates.
  void build(State& state, NormalEquations& equations) const;
  /// Builds gradients and cost only; the matrices are unchanged.
  void buildGradient(State& state, NormalEquations& equations) const;
  /// Computes the cost only. Requires an up-to-date PoseBlock::at_estimate.
  double value(const State& state) const;

  /// Terms as they enter the prior: as in the last solve if they were in it (textbook), else at the current values.
  SensorTerm sensorTerm(const State& state, const LandmarkBlock& landmark, const Measurement& measurement,
                        const PoseBlock& pose) const;
  ProcessTerm processTerm(const PoseBlock& last, const PoseBlock& next) const;

  const SensorModel& sensor() const { return sensor_; }
  bool lineariseFirst() const { return linearise_first_; }

 private:
  template <bool with_matrices>
  void accumulate(State& state, NormalEquations& equations) const;
  template <bool with_matrices>
  void accumulateProcess(State& state, NormalEquations& equations) const;
  // Returns the weight of a residual, and its robust cost in `cost`.
  double weigh(double squared, double& cost) const;

  SensorModel sensor_;
  double huber_;
  bool linearise_first_;
};

}  // namespace swf_vo
