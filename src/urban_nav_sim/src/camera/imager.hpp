// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "camera/exposure.hpp"
#include "camera/motion_blur.hpp"
#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Converts light to grey levels: motion blur, point spread, vignetting, noise, 8 bits. Not thread-safe, since it keeps
/// buffers; uses several threads, without effect on the result.
class Imager {
 public:
  struct Settings {
    double vignetting = 0.30;  ///< share of light lost in the corners
    double spread =
        0.44;  ///< px, sigma of the point spread in addition to the filter of appearances (materials/tile.cpp)
    double read_noise = 0.40;  ///< grey levels without gain
    /// Levels^2 per level without gain. Not from a data sheet: with it and the above, frames have about the noise of
    /// real ones (bench/realism).
    double shot_noise = 0.0033;
    double sensitivity = 1.0;                                 ///< relative to the other imagers of the head
    Eigen::Vector3f white_balance = Eigen::Vector3f::Ones();  ///< factors of red, green, blue
    double gamma = 1.0;                                       ///< 255 (level / 255)^gamma
    bool blurs = true, is_noisy = true;
  };
  Imager(const Lens& lens, const Settings& settings, const Noise& noise);

  const RayTable& rays() const { return rays_; }
  /// Returns an 8 bit image, grey or BGR. `levels`: grey levels for a radiance of 1; `number`: of the frame, for noise.
  cv::Mat develop(const Picture& picture, const CameraMotion& motion, const Exposure& exposure, double levels,
                  std::uint64_t number);

 private:
  void developRow(const Picture& picture, const std::vector<float>& radiance, int v, float levels, float gain,
                  const Noise& noise, std::uint8_t* out) const;

  RayTable rays_;
  Settings settings_;
  Noise noise_;
  std::vector<float> vignetting_;
  std::array<std::uint8_t, 1024> curve_{};  ///< of quarters of a level
  std::vector<float> smeared_;
};

}  // namespace urban_nav_sim
