// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/misfit.hpp"

#include <algorithm>
#include <cmath>

namespace swf_vo {

namespace {

constexpr double gate = 4.0;          // standard deviations, by the median deviation
constexpr double deviation = 1.4826;  // standard deviation of a Gaussian over its median deviation
constexpr std::size_t renewal = 8;    // patches between two looks at the median

}  // namespace

bool Misfit::isUsual(double noise) {
  recent_[count_ % size] = noise;
  ++count_;
  if (count_ < enough) return true;
  if (limit_ == 0.0 || count_ % renewal == 0) {
    const std::size_t known = std::min(count_, size);
    const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(known),
               middle = sorted_.begin() + static_cast<std::ptrdiff_t>(known / 2);
    std::copy_n(recent_.begin(), known, sorted_.begin());
    std::nth_element(sorted_.begin(), middle, end);
    const double median = *middle;
    std::transform(sorted_.begin(), end, sorted_.begin(), [median](double value) { return std::abs(value - median); });
    std::nth_element(sorted_.begin(), middle, end);
    limit_ = median + gate * deviation * *middle;
  }
  return noise <= limit_;
}

}  // namespace swf_vo
