// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace urban_nav_core::testing {

/// Numbers drawn from a seed, the same with every compiler: the distributions of the standard library differ between
/// implementations, its engine does not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /// In (0, 1), 53 bits.
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// 0 ... count - 1, count > 0.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count)) % count;
  }
  bool chance(double probability) { return uniform() < probability; }
  /// Standard normal (Box and Muller 1958).
  double normal() {
    const double length = std::sqrt(-2.0 * std::log(uniform()));
    return length * std::cos(6.283185307179586 * uniform());
  }
  /// Independent standard normal numbers, in order.
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
