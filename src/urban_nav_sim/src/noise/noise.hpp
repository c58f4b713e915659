// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

namespace urban_nav_sim {

/// Returns a standard normal number at a resolution of 32 bits: |value| at most 6.8 (Box and Muller 1958, one of the
/// two), from 64 uniform bits.
double normalFrom(std::uint64_t bits);

/// A stream of random numbers as a function of a counter: stateless, so any thread may read any number in any order,
/// repeatably. Streams are distinguished by a seed and a name (or number); those of one seed are independent of each
/// other. Only integers and + - * / sqrt of doubles are used, no function of libm, so the bits are the same on every
/// machine.
///
///   const Noise noise(seed, "laser_left");
///   range += 0.005 * noise.of(scan).normal(beam);
///
/// The bits are those of SplitMix (Steele, Lea, Flood, Fast splittable pseudorandom number generators, OOPSLA 2014): a
/// Weyl sequence with an odd step for each stream, mixed by Stafford's variant 13.
class Noise {
 public:
  Noise(std::uint64_t seed, std::string_view name);
  Noise(std::uint64_t seed, std::uint64_t number);

  /// Returns a substream. Cheap enough for every row, beam or second.
  Noise of(std::uint64_t number) const;
  Noise of(std::string_view name) const;

  /// Returns 64 uniform bits.
  std::uint64_t bits(std::uint64_t counter) const { return mixed(start_ + counter * step_); }
  /// Returns a uniform number in [0, 1), in steps of 2^-53.
  double uniform(std::uint64_t counter) const { return static_cast<double>(bits(counter) >> 11) * 0x1.0p-53; }
  double uniform(std::uint64_t counter, double low, double high) const { return low + (high - low) * uniform(counter); }
  /// Returns a uniform integer 0 ... count - 1; `count` from 1 to 2^32.
  std::uint64_t below(std::uint64_t counter, std::uint64_t count) const {
    return ((bits(counter) >> 32) * count) >> 32;
  }
  /// Returns true with this probability.
  bool chance(std::uint64_t counter, double probability) const { return uniform(counter) < probability; }
  /// normalFrom(bits(counter)).
  double normal(std::uint64_t counter) const { return normalFrom(bits(counter)); }
  /// Returns three independent numbers, also independent of `normal` at the same counter.
  Eigen::Vector3d normal3(std::uint64_t counter) const;
  /// Returns the scaled sum of the eight bytes: mean 0, variance 1, steps of 1/209, |value| at most 4.9, fourth moment
  /// 2.85 (normal: 3). For pixels, five times as fast as `normal`.
  float roughNormal(std::uint64_t counter) const;

 private:
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  }

  std::uint64_t start_, step_;
};

}  // namespace urban_nav_sim
