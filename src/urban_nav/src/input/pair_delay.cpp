// SPDX-License-Identifier: BSD-3-Clause
#include "input/pair_delay.hpp"

#include <algorithm>
#include <cstdlib>

namespace urban_nav {

using urban_nav_core::StampNs;

std::optional<StampNs> constantDelay(const std::vector<StampNs>& left, const std::vector<StampNs>& right) {
  constexpr std::size_t kLeast = 3;
  constexpr StampNs kConstant = 2'000'000;  // ns
  constexpr double kMost = 0.8;             // share of images with that delay
  if (left.size() < kLeast || right.size() < kLeast) return std::nullopt;
  std::vector<StampNs> delays;
  for (const StampNs stamp : left) {
    const auto after = std::lower_bound(right.begin(), right.end(), stamp);
    StampNs nearest = after == right.end() ? right.back() - stamp : *after - stamp;
    if (after != right.begin() && stamp - *(after - 1) < std::abs(nearest)) nearest = *(after - 1) - stamp;
    delays.push_back(nearest);
  }
  const auto middle = delays.begin() + static_cast<std::ptrdiff_t>(delays.size() / 2);
  std::nth_element(delays.begin(), middle, delays.end());
  const StampNs median = *middle;
  const auto alike = std::count_if(delays.begin(), delays.end(),
                                   [median](StampNs delay) { return std::abs(delay - median) <= kConstant; });
  if (static_cast<double>(alike) < kMost * static_cast<double>(delays.size())) return std::nullopt;
  return median;
}

}  // namespace urban_nav
