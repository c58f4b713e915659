// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/marginalise.hpp"
#include "window/prior.hpp"

namespace swf_vo {

/// Process noise of landmarks: the point that a template stands for drifts over the surface as the view of it changes
/// (front_end/refine.hpp), so that information of old frames decays. In information form,
///   Pi' = (Pi^-1 + Q)^-1 = Pi - Pi E (E^T Pi E + Q^-1)^-1 E^T Pi
/// with E picking the bearings of the landmarks that have moved. Centres stay, so what is empty in Pi stays empty.
/// Derivation: docs/derivations/landmark_process_noise.md.
class LandmarkProcessNoise {
 public:
  struct Step {
    int block;                   ///< landmark of the prior
    Eigen::Matrix2d covariance;  ///< of its bearing (a, b), positive definite
  };

  /// Adds the steps to the prior, each block at most once. `departed`, what the pose that left owes to the blocks of
  /// the prior, is said of where they are now; its gauge_loss grows by what the prior no longer knows of the gauge
  /// (`directions`: gauge::ofPrior).
  void apply(const std::vector<Step>& steps, const std::vector<double>& directions, Prior& prior, Departed& departed);

 private:
  static constexpr int kGroup = 8, kMost = 2 * kGroup;  // landmarks taken together, and their rows
  void apply(const Step* steps, int count, const std::vector<double>& directions, Prior& prior, Departed& departed);
  void gather(const Step* steps, int count, const Prior& prior);
  void factor(const Step* steps, int count);

  std::size_t stride_ = 0;
  std::vector<double> columns_;  // Pi E, then times L^-T
  int row_[kMost] = {};
  double L_[kMost][kMost] = {};  // L L^T = E^T Pi E + Q^-1
  StripProduct product_;
};

}  // namespace swf_vo
