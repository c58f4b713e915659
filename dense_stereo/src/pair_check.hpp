// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/dense_stereo.hpp"

namespace dense_stereo {

/// Result of the pixel-level checks of a pair, before matching.
struct PairCheck {
  Reason reason = Reason::None;
  std::string sentence;
  bool usable = true;     ///< false: all pixels of this pair remain invalid
  double exposure = 1.0;  ///< contrast of the left image divided by that of the right one
  double offset = 0.0;    ///< grey levels: left is about exposure times right plus this
};

/// Detects missing or unequal images, images without contrast, exchanged images and unequal exposure. Takes about 0.1
/// ms at 512x384. `may_be_swapped`: false if the images are known not to be exchanged.
PairCheck checkPair(const urban_nav_core::StereoPair& pair, bool may_be_swapped = true);

}  // namespace dense_stereo
