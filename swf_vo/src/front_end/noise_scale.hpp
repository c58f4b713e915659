// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Ratio of actual measurement variance to the variance computed by the alignment, estimated from the residuals of the
/// window. The alignment models image noise only: not that an edge is not straight, that a patch is curved, or that
/// part of it is further away. The ratio differs by a factor of ten between landmarks and is constant over the life of
/// each, so each landmark has its own estimate, shrunk towards the typical value of the others, which has the weight of
/// one or two frames (empirical Bayes: mean of an inverse gamma distribution). At least one.
class NoiseScale {
 public:
  /// Residual statistics of one landmark; older frames have less weight.
  struct Own {
    double squares = 0.0;      ///< squared residuals, in standard deviations of their alignments
    double coordinates = 0.0;  ///< expected value of `squares`
  };

  /// `capacity`: landmarks of a frame; memory is allocated at construction.
  explicit NoiseScale(int capacity) { scales_.reserve(static_cast<std::size_t>(capacity)); }

  /// Adds a residual. `squared`: r^T Omega r of a measurement against the window, which contains that measurement;
  /// `coordinates`: its expected value. Requires both >= 0.
  void see(double squared, double coordinates, Own& own);
  /// Updates the typical value, after all landmarks of a frame.
  void learn();
  /// Scale of a new landmark.
  double typical() const;
  double of(const Own& own) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  double typical_ = 1.0;
  double rate_ = 1.0;           // weight of the newest frame: a mean over the first frames, then exponential forgetting
  std::vector<double> scales_;  // scales of this frame, one for each measurement
};

}  // namespace swf_vo
