// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/noise_scale.hpp"

#include <algorithm>

namespace swf_vo {

namespace {

constexpr double noise_memory = 0.98;         // of a frame, in the next one
constexpr double prior_coordinates = 4;       // that what is usual counts for
constexpr double chi_square_median = 0.789;   // of 3 degrees of freedom, by degree
constexpr std::size_t fewest_residuals = 12;  // landmarks, to know what is usual
constexpr double slowest = 0.1;               // share of a frame in what is usual, once more than ten are known
// One residual counts for no more than this many usual ones: what is so far off is something else.
constexpr double largest = 65.0;

}  // namespace

void NoiseScale::see(double squared, double coordinates, Own& own) {
  if (!(coordinates > 0.0)) return;
  const double counted = std::min(squared, largest * typical());
  own.squares = noise_memory * own.squares + counted;
  own.coordinates = noise_memory * own.coordinates + coordinates;
  scales_.push_back(counted / coordinates);
}

void NoiseScale::learn() {
  if (scales_.size() >= fewest_residuals) {
    const auto middle = scales_.begin() + static_cast<std::ptrdiff_t>(scales_.size() / 2);
    std::nth_element(scales_.begin(), middle, scales_.end());
    rate_ = std::max(slowest, rate_ / (1.0 + rate_));
    typical_ += rate_ * (*middle / chi_square_median - typical_);
  }
  scales_.clear();
}

double NoiseScale::typical() const { return std::max(1.0, typical_); }

double NoiseScale::of(const Own& own) const {
  return std::max(1.0, (prior_coordinates * typical_ + own.squares) / (prior_coordinates + own.coordinates));
}

void NoiseScale::archive(urban_nav_core::Archive& archive) { archive(typical_, rate_); }

}  // namespace swf_vo
