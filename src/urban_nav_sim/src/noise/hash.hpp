// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace urban_nav_sim {

/// Counter-based random numbers: a number is a function of its seed, stream and index, hence independent of the order
/// of calls and of the number of threads. Mixing of splitmix64 (Steele et al. 2014, figure 1 and variant 13).
inline std::uint64_t hash(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

template <typename... More>
std::uint64_t hash(std::uint64_t x, std::uint64_t y, More... more) {
  return hash(hash(x) ^ y, static_cast<std::uint64_t>(more)...);
}

/// Returns 0 <= u < 1 from the upper 53 bits.
inline double toUniform(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

/// Returns a standard normal number: Box and Muller of the number and its successor in the stream.
inline double toNormal(std::uint64_t bits) {
  const double u = 1.0 - toUniform(bits), v = toUniform(hash(bits));
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
}

/// A sequential stream of such numbers. Not thread-safe.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t bits() { return hash(seed_, count_++); }
  double uniform() { return toUniform(bits()); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() { return toNormal(bits()); }
  /// 0 ... n - 1
  int index(int n) { return static_cast<int>(uniform() * n); }
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t seed_, count_ = 0;
};

}  // namespace urban_nav_sim
