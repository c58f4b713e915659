// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dense_stereo/disparity_image.hpp"

namespace dense_stereo {

template <typename T>
class Padded;

/// A pair as a matcher gets it. Images are those of the caller; `padded.hpp` of the sources defines their type.
struct MatcherInput {
  const Padded<std::uint8_t>& left;   ///< rows extended by extendRows
  const Padded<std::uint8_t>& right;  ///< of the same size, in the exposure of the left image
};

/// A method of dense matching. DenseStereo and NearSceneEstimator use the one that they are given, or the stage's own.
/// Matchers are written in this package: the stage's own in `src/sgm`, others, each in a library of its own, in
/// `reference`. Keeps its memory between pairs; the result of a pair does not depend on earlier pairs.
class Matcher {
 public:
  virtual ~Matcher() = default;
  /// Sets the disparity and the variance of each pixel. Requires an `image` of the size of the pair without a valid
  /// pixel.
  virtual void match(const MatcherInput& input, DisparityImage& image) = 0;
};

}  // namespace dense_stereo
