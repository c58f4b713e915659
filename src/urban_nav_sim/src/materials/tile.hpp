// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace urban_nav_sim {

/// Footprint of a pixel on a surface as an ellipse: `length` is the long axis (m, full length), `width` the short one.
struct Footprint {
  Eigen::Vector2f length = Eigen::Vector2f::Zero();
  float width = 0.0F;
  int taps = 1;  ///< number of discs of `width` along the length
};

/// Returns the footprint from the change of position to the pixel on the right and to the one below. Footprints longer
/// than `most_taps` widths are widened, which bounds the time of a look-up and costs sharpness but keeps the mean.
Footprint computeFootprint(const Eigen::Vector2f& per_u, const Eigen::Vector2f& per_v, int most_taps);

/// Two periodic functions on a plane with a pyramid of smoothed copies (Williams 1983): `mix` (0 ... 1) between two
/// colours, `tone` (-1 ... 1, by convention with mean zero) for lightness. The mean over a footprint equals that of its
/// texels to 1e-4 without a shift: levels are weighted means, symmetric about their texels.
class Tile {
 public:
  struct Value {
    float mix = 0.0F, tone = 0.0F;
  };

  /// `size`: texels per side, a power of two. `mix` and `tone`: row-major, clamped to their range. `period`: m.
  Tile(int size, float period, const std::vector<float>& mix, const std::vector<float>& tone);

  float period() const { return period_; }
  /// Returns the values at a position (m) for a disc of `width` (m): linear between texels and between levels.
  Value read(const Eigen::Vector2f& at, float width) const;
  /// Returns the mean over the taps of a footprint, which are symmetric about `at`.
  Value read(const Eigen::Vector2f& at, const Footprint& footprint) const;
  Value mean() const { return mean_; }

  /// Shifts each copy of the tile by a hash of its position, in whole steps (m), so that joints match at the borders.
  /// For bonds whose pattern repeats after such a step.
  void shuffle(const Eigen::Vector2f& step);

 private:
  struct Texel {
    std::uint16_t mix, tone;
  };
  /// In texels and units of 1/65535: `mix` and `tone` in lanes 0 and 1, the latter offset to 0. `cell`, `part`: x and
  /// y.
  template <typename Lanes>
  Lanes bilinear(int level, const int* cell, const float* part) const;
  Eigen::Vector2f shuffled(const Eigen::Vector2f& at) const;

  int size_ = 0, levels_ = 0;
  float period_ = 1.0F, texels_per_metre_ = 1.0F;
  Eigen::Vector2f step_ = Eigen::Vector2f::Zero();
  Value mean_;
  std::vector<Texel> texels_;         ///< by level, strip and row (tile.cpp)
  std::vector<std::uint32_t> first_;  ///< first texel of each level
  std::vector<float> scales_;         ///< texels per metre of each level
};

}  // namespace urban_nav_sim
