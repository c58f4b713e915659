// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dense_stereo/disparity_image.hpp"

namespace dense_stereo {

template <typename T>
class Padded;

/// Input of a matcher. The caller owns the images; their type is defined in `padded.hpp` of the sources.
struct MatcherInput {
  const Padded<std::uint8_t>& left;   ///< rows extended by extendRows
  const Padded<std::uint8_t>& right;  ///< of the same size, brightness adjusted to the left image
};

/// Method of dense matching, used by DenseStereo and NearSceneEstimator. Matchers are part of this package: semi-global
/// matching in `src/sgm`, others in `reference`, each in a separate library. Keeps its buffers between pairs; the
/// result of a pair does not depend on earlier pairs.
class Matcher {
 public:
  virtual ~Matcher() = default;
  /// Sets the disparity and the variance of each pixel. Requires an `image` of the size of the pair in which all pixels
  /// are invalid.
  virtual void match(const MatcherInput& input, DisparityImage& image) = 0;
};

}  // namespace dense_stereo
