// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace urban_nav_sim {

/// Which part of a surface a pixel sees, as an ellipse: `length` is the long axis (m, both ends), `width` the short
/// one.
struct Footprint {
  Eigen::Vector2f length = Eigen::Vector2f::Zero();
  float width = 0.0F;
  int taps = 1;  ///< how many discs of `width` side by side make up the length
};

/// From the change of place to the pixel on the right and to the one below. A pixel that sees a strip longer than
/// `most_taps` widths gets a wider one, so the look-up's time is bounded; what is lost is sharpness, not the mean.
Footprint computeFootprint(const Eigen::Vector2f& per_u, const Eigen::Vector2f& per_v, int most_taps);

/// Two numbers for each place of a plane, periodic in both directions, with a pyramid (Williams 1983) of smoothed
/// copies: `mix` (0 ... 1) says which of two colours is there, `tone` (-1 ... 1, mean zero by custom) how light it is.
/// The mean over any footprint is that of the texels under it, to 1e-4 and without a shift: levels are weighted means,
/// symmetric about their texels.
class Tile {
 public:
  struct Value {
    float mix = 0.0F, tone = 0.0F;
  };

  /// `size`: texels a side, a power of two. `mix` and `tone`: row by row, clamped to their range. `period`: m.
  Tile(int size, float period, const std::vector<float>& mix, const std::vector<float>& tone);

  float period() const { return period_; }
  /// At a place (m), as a disc of `width` (m) sees it: linear between texels and between levels.
  Value read(const Eigen::Vector2f& at, float width) const;
  /// The same for a strip: the mean of its taps, which lie symmetrically about `at`.
  Value read(const Eigen::Vector2f& at, const Footprint& footprint) const;
  Value mean() const { return mean_; }

  /// Lets copies of the tile lie side by side in another order: each is moved by a hash of its place, in whole steps
  /// (m), so that joints meet at the borders. For bonds whose pattern repeats after such a step.
  void shuffle(const Eigen::Vector2f& step);

 private:
  struct Texel {
    std::uint16_t mix, tone;
  };
  /// In units of texels and of 65535: `mix` and `tone` in lanes 0 and 1, the latter from 0 on. `cell`, `part`: x and y.
  template <typename Lanes>
  Lanes bilinear(int level, const int* cell, const float* part) const;
  Eigen::Vector2f shuffled(const Eigen::Vector2f& at) const;

  int size_ = 0, levels_ = 0;
  float period_ = 1.0F, texels_per_metre_ = 1.0F;
  Eigen::Vector2f step_ = Eigen::Vector2f::Zero();
  Value mean_;
  std::vector<Texel> texels_;         ///< level after level, strips within, rows within these (tile.cpp)
  std::vector<std::uint32_t> first_;  ///< where a level begins
  std::vector<float> scales_;         ///< texels a metre, of each level
};

}  // namespace urban_nav_sim
