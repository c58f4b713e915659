// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/noise_scale.hpp"

#include <algorithm>

namespace swf_vo {

namespace {

constexpr double kNoiseMemory = 0.98;         // weight of a frame in the next one
constexpr double kPriorCoordinates = 4;       // weight of the typical scale
constexpr double kChiSquareMedian = 0.789;    // for 3 degrees of freedom, per degree
constexpr std::size_t kFewestResiduals = 12;  // landmarks required for the typical scale
constexpr double kSlowest = 0.1;              // weight of a frame in the typical scale, after the first ten
// Limit of a residual in units of the typical one: larger ones are outliers.
constexpr double kLargest = 65.0;

}  // namespace

void NoiseScale::see(double squared, double coordinates, Own& own) {
  if (!(coordinates > 0.0)) return;
  const double counted = std::min(squared, kLargest * typical());
  own.squares = kNoiseMemory * own.squares + counted;
  own.coordinates = kNoiseMemory * own.coordinates + coordinates;
  scales_.push_back(counted / coordinates);
}

void NoiseScale::learn() {
  if (scales_.size() >= kFewestResiduals) {
    const auto middle = scales_.begin() + static_cast<std::ptrdiff_t>(scales_.size() / 2);
    std::nth_element(scales_.begin(), middle, scales_.end());
    rate_ = std::max(kSlowest, rate_ / (1.0 + rate_));
    typical_ += rate_ * (*middle / kChiSquareMedian - typical_);
  }
  scales_.clear();
}

double NoiseScale::typical() const { return std::max(1.0, typical_); }

double NoiseScale::of(const Own& own) const {
  return std::max(1.0, (kPriorCoordinates * typical_ + own.squares) / (kPriorCoordinates + own.coordinates));
}

void NoiseScale::archive(urban_nav_core::Archive& archive) { archive(typical_, rate_); }

}  // namespace swf_vo
