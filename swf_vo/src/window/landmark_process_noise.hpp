// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/marginalise.hpp"
#include "window/prior.hpp"

namespace swf_vo {

/// Process noise of landmarks: the point represented by a template drifts over the surface as the view changes
/// (front_end/refine.hpp), so that information of old frames decays. In information form,
///   Pi' = (Pi^-1 + Q)^-1 = Pi - Pi E (E^T Pi E + Q^-1)^-1 E^T Pi
/// with E selecting the bearings of the landmarks that have drifted. Centres are unchanged, and the null space of Pi is
/// preserved. Derivation: docs/derivations/landmark_process_noise.md.
class LandmarkProcessNoise {
 public:
  struct Step {
    int block;                   ///< landmark of the prior
    Eigen::Matrix2d covariance;  ///< covariance of its bearing (a, b), positive definite
  };

  /// Adds the steps to the prior, each block at most once. Transforms `departed`, the gain of the last marginalised
  /// pose, accordingly, and adds to its gauge_loss the information that the prior loses in the gauge directions
  /// (`directions`: gauge::ofPrior).
  void apply(const std::vector<Step>& steps, const std::vector<double>& directions, Prior& prior, Departed& departed);

 private:
  static constexpr int kGroup = 8, kMost = 2 * kGroup;  // landmarks processed together, and their rows
  void apply(const Step* steps, int count, const std::vector<double>& directions, Prior& prior, Departed& departed);
  void gather(const Step* steps, int count, const Prior& prior);
  void factor(const Step* steps, int count);

  std::size_t stride_ = 0;
  std::vector<double> columns_;  // Pi E, then multiplied by L^-T
  int row_[kMost] = {};
  double L_[kMost][kMost] = {};  // L L^T = E^T Pi E + Q^-1
  StripProduct product_;
};

}  // namespace swf_vo
