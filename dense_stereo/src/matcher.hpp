// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dense_stereo/disparity_image.hpp"
#include "padded.hpp"

namespace dense_stereo {

/// Brightness of the right image in terms of the left one's, as far as it is known before matching: left is about
/// gain times right plus offset.
struct MatcherInput {
  const Padded<std::uint8_t>& left;   ///< rows extended by extendRows
  const Padded<std::uint8_t>& right;  ///< brought to the exposure of the left image
};

/// A method: from two images of equal size to disparities. Keeps its memory between pairs.
class Matcher {
 public:
  virtual ~Matcher() = default;
  virtual void match(const MatcherInput& input, DisparityImage& image) = 0;
};

}  // namespace dense_stereo
