// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swf_vo {

/// Parts of the method that comparisons switch off. The default switches off none; other values come from library
/// swf_vo_ablation (reference/ablation) alone.
struct Ablation {
  bool delete_departed = false;   ///< deletes poses and landmarks that leave the window instead of marginalising them
                                  ///< into the prior (classic visual odometry)
  bool latest_jacobians = false;  ///< linearises blocks touched by the prior at their latest estimates instead of the
                                  ///< first (textbook Kalman filter)
  bool whole_pixels = false;      ///< places corners to the next whole pixel instead of a hundredth of one
};

}  // namespace swf_vo
