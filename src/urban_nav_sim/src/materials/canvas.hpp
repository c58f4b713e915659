// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace urban_nav_sim {

/// Square single-channel image with periodic boundaries, on which tiles are drawn.
class Canvas {
 public:
  explicit Canvas(int size, float value = 0.0F)
      : size_(size), values_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), value) {}

  int size() const { return size_; }  ///< a power of two
  float& at(int x, int y) { return values_[index(x, y)]; }
  float at(int x, int y) const { return values_[index(x, y)]; }
  std::vector<float>& values() { return values_; }
  const std::vector<float>& values() const { return values_; }

 private:
  std::size_t index(int x, int y) const {
    const int mask = size_ - 1;
    return static_cast<std::size_t>(y & mask) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x & mask);
  }

  int size_;
  std::vector<float> values_;
};

/// Subtracts the mean and divides by the standard deviation.
void standardise(Canvas& canvas);

/// Returns value noise summed over octaves: `cells_x`, `cells_y` lattice cells in the first, twice as many in each
/// further octave, whose amplitude is `gain` times that of the previous one. Mean 0, standard deviation 1.
Canvas fractalNoise(int size, int cells_x, int cells_y, int octaves, float gain, std::uint64_t seed);

/// Distances to random points, one in each cell of a jittered lattice (Worley 1996).
struct Pebbles {
  Canvas edge;  ///< second nearest minus nearest distance, in cells: 0 between pebbles
  Canvas id;    ///< 0 ... 1, constant over a pebble
};
Pebbles pebbles(int size, int cells, float jitter, std::uint64_t seed);

/// 0 below `low`, 1 above `high`, smooth between.
float smoothStep(float low, float high, float x);

}  // namespace urban_nav_sim
