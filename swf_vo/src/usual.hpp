// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace swf_vo {

/// Up to where values are as they usually are: the median, and four standard deviations by the median deviation. There must be one
/// at least; their order, and then the values themselves, are lost.
template <typename Iterator>
double usualLimit(Iterator begin, Iterator end) {
  constexpr double gate = 4.0;
  constexpr double deviation = 1.4826;  // standard deviation of a Gaussian over its median deviation
  const Iterator middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  const double median = *middle;
  std::transform(begin, end, begin, [median](double value) { return std::abs(value - median); });
  std::nth_element(begin, middle, end);
  return median + gate * deviation * *middle;
}

}  // namespace swf_vo
