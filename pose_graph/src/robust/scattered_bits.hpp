// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pose_graph {

/// 64 bits that look drawn, from a number alone (splitmix64, Steele, Lea, Flood 2014).
inline std::uint64_t scatteredBits(std::uint64_t number) {
  std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Evenly over 0...most - 1, from `number` alone.
inline std::size_t drawIndex(std::uint64_t number, std::size_t most) { return scatteredBits(number) % most; }

}  // namespace pose_graph
