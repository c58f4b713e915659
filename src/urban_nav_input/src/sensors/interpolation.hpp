// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

constexpr urban_nav_core::StampNs kLongestInterpolatedGap = 300'000'000;  // ns between messages

/// Returns the value of a series at a stamp, between two messages; nullopt in a gap.
template <typename ValueOf>
std::optional<double> interpolate(const std::vector<urban_nav_core::StampNs>& stamps, const ValueOf& value_of,
                                  urban_nav_core::StampNs at) {
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), at);
  if (after == stamps.begin() || after == stamps.end() || *after - *(after - 1) > kLongestInterpolatedGap)
    return std::nullopt;
  const auto i = static_cast<std::size_t>(after - stamps.begin());
  const double share = static_cast<double>(at - stamps[i - 1]) / static_cast<double>(stamps[i] - stamps[i - 1]);
  return value_of(i - 1) + share * (value_of(i) - value_of(i - 1));
}

}  // namespace urban_nav_input
