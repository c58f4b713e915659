// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// By how much the errors of measurements are larger than their alignments say, as variance, learnt from what they
/// leave against the window. An alignment knows the noise of the images. It does not know that an edge is no straight
/// line of pixels, that a patch bends, or that half of it lies further back; nor would a constant, for landmarks differ
/// by a factor of ten in this, and each stays as it is for as long as it lives. So each has a scale of its own; what is
/// usual among the others counts like a frame or two of it (empirical Bayes: the mean of an inverse gamma
/// distribution), and alone where nothing is known of it yet. A scale is never below one.
class NoiseScale {
 public:
  /// What a landmark has left so far; older frames count for less.
  struct Own {
    double squares = 0.0;      ///< of residuals, in the standard deviations of their alignments
    double coordinates = 0.0;  ///< how many would be expected of them
  };

  /// `capacity`: landmarks of a frame, for which memory is taken at once.
  explicit NoiseScale(int capacity) { scales_.reserve(static_cast<std::size_t>(capacity)); }

  /// `squared`: r^T Omega r of a measurement against the window that has it; `coordinates`: what is expected of that.
  /// Both >= 0.
  void see(double squared, double coordinates, Own& own);
  /// After all landmarks of a frame.
  void learn();
  /// Of a landmark that was just born.
  double typical() const;
  double of(const Own& own) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  double typical_ = 1.0;
  double rate_ = 1.0;           // of the mean over the first frames, then of one that forgets
  std::vector<double> scales_;  // of this frame, each of one measurement
};

}  // namespace swf_vo
