// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "camera/render.hpp"

namespace urban_nav_sim {

/// How long the shutter is open, and what is made of it.
struct Exposure {
  double seconds = 0.002;
  double gain = 1.0;
};

/// Automatic exposure as a Bumblebee2 has it (its reference manual): mean grey of the lower two thirds of the image
/// towards 110, shutter first, up to 10 ms, then gain; a picture bears on the second one after it, and no step is
/// larger than a tenth. Judges the light alone, not its noise.
class AutoExposure {
 public:
  struct Settings {
    double target = 110.0;          ///< grey levels
    double white_seconds = 0.0012;  ///< a radiance of 1 gives 255 levels in this time without gain
    double longest = 0.010;         ///< s
    double largest_gain = 8.0;
    double step = 0.1;   ///< share by which exposure changes from frame to frame at most
    int lag = 2;         ///< frames
    bool adapts = true;  ///< without: all pictures have the exposure of the first
  };
  AutoExposure() : AutoExposure(Settings()) {}
  explicit AutoExposure(const Settings& settings) : settings_(settings) {}

  /// The exposure of the picture that is taken now, and what it means for those to come. Before the first picture the
  /// camera has looked at the same for a while.
  Exposure next(const Picture& picture);
  /// Grey levels for a radiance of 1.
  double levels(const Exposure& exposure) const {
    return 255.0 * exposure.seconds * exposure.gain / settings_.white_seconds;
  }

 private:
  double wanted(const Picture& picture, double product) const;

  Settings settings_;
  std::deque<double> products_;  ///< seconds times gain, of this picture and those decided on
};

}  // namespace urban_nav_sim
