// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace urban_nav_core::testing {

/// Random numbers from a seed, equal with every compiler: the distributions of the standard library differ between
/// implementations, its engines do not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /// Returns a number in (0, 1) with 53 random bits.
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Returns an integer in 0 ... count - 1, count > 0.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count)) % count;
  }
  bool chance(double probability) { return uniform() < probability; }
  /// Returns a standard normal number (Box and Muller 1958).
  double normal() {
    const double length = std::sqrt(-2.0 * std::log(uniform()));
    return length * std::cos(6.283185307179586 * uniform());
  }
  /// Returns independent standard normal numbers.
  template <int Size>
  Eigen::Matrix<double, Size, 1> normals() {
    Eigen::Matrix<double, Size, 1> drawn;
    for (int i = 0; i < Size; ++i) drawn[i] = normal();
    return drawn;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace urban_nav_core::testing
