// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "camera/render.hpp"

namespace urban_nav_sim {

/// Shutter time and gain.
struct Exposure {
  double seconds = 0.002;
  double gain = 1.0;
};

/// Automatic exposure of a Bumblebee2 (its reference manual): controls the mean grey of the lower two thirds of the
/// image to 110, by the shutter up to 10 ms, then by gain (at night, 45 ms and 24 dB: limits of the camera itself at
/// 20 Hz); a picture affects the second one after it, in steps of at
/// most a tenth. Based on light without noise.
class AutoExposure {
 public:
  struct Settings {
    double target = 110.0;          ///< grey levels
    double white_seconds = 0.0012;  ///< a radiance of 1 gives 255 levels in this time without gain
    double longest = 0.010;         ///< s
    double largest_gain = 8.0;
    double step = 0.1;   ///< largest relative change of exposure between frames
    int lag = 2;         ///< frames
    bool adapts = true;  ///< false: all pictures have the exposure of the first
  };
  AutoExposure() : AutoExposure(Settings()) {}
  explicit AutoExposure(const Settings& settings) : settings_(settings) {}

  /// Returns the exposure of the current picture, and updates that of later ones. The first picture has the settled
  /// exposure of its scene.
  Exposure next(const Picture& picture);
  /// Returns the grey levels for a radiance of 1.
  double levels(const Exposure& exposure) const {
    return 255.0 * exposure.seconds * exposure.gain / settings_.white_seconds;
  }

 private:
  double wanted(const Picture& picture, double product) const;

  Settings settings_;
  std::deque<double> products_;  ///< seconds times gain, of this picture and those decided on
};

}  // namespace urban_nav_sim
