// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace swf_vo {

/// Returns median + 4 sigma of the values, with sigma = 1.4826 times the median absolute deviation. Requires at least
/// one value. Overwrites the values.
template <typename Iterator>
double robustThreshold(Iterator begin, Iterator end) {
  constexpr double kGate = 4.0;
  constexpr double kDeviation = 1.4826;  // standard deviation of a Gaussian over its median absolute deviation
  const Iterator middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  const double median = *middle;
  std::transform(begin, end, begin, [median](double value) { return std::abs(value - median); });
  std::nth_element(begin, middle, end);
  return median + kGate * kDeviation * *middle;
}

}  // namespace swf_vo
