// SPDX-License-Identifier: BSD-3-Clause
#include "session/pair_delay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_input {

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

std::string describeDelay(const std::vector<StampNs>& left, const std::vector<StampNs>& right) {
  constexpr StampNs kPaired = 5'000'000;
  const std::optional<StampNs> delay = constantDelay(left, right);
  if (!delay || std::abs(*delay) <= kPaired) return "";
  const double ms = std::round(1e-4 * static_cast<double>(*delay)) / 100.0;  // to 0.01 ms
  return "; the right images are stamped " + urban_nav_core::printNumber(std::abs(ms)) + " ms " +
         (ms > 0.0 ? "later" : "earlier") +
         " than the left ones: if they are exposed together, --set input.right_delay=" +
         urban_nav_core::printNumber(ms) + " shifts their stamps";
}

}  // namespace urban_nav_input
