// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swf_vo {

/// Parts of the method that can be switched off for comparison. The default switches off none; other values are set
/// only by the library swf_vo_ablation (reference/ablation).
struct Ablation {
  bool delete_departed = false;   ///< deletes poses and landmarks that leave the window instead of marginalising them
                                  ///< into the prior (classic visual odometry)
  bool latest_jacobians = false;  ///< linearises blocks touched by the prior at their latest estimates instead of the
                                  ///< first (textbook Kalman filter)
  bool whole_pixels = false;      ///< rounds corner positions to whole pixels instead of hundredths
};

}  // namespace swf_vo
