// SPDX-License-Identifier: BSD-3-Clause
#include "motion/time_spline.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace urban_nav_sim {
namespace {

constexpr std::size_t kTaps = 6;

// Row j: 120 times the weight of control point j on one segment, as coefficients of the powers of the local parameter
// (de Boor's recursion for uniform knots).
constexpr double kPowers[kTaps][kTaps] = {{1, -5, 10, -10, 5, -1},  {26, -50, 20, 20, -20, 5},
                                          {66, 0, -60, 0, 30, -10}, {26, 50, 20, -20, -20, 10},
                                          {1, 5, 10, 10, 5, -5},    {0, 0, 0, 0, 0, 1}};

}  // namespace

TimeSpline::TimeSpline(double first, double step, std::vector<Vector6> control)
    : first_(first), step_(step), control_(std::move(control)) {
  assert(control_.size() >= kTaps && step_ > 0.0);
}

TimeSpline::Value TimeSpline::at(double t) const {
  const double place = (t - begin()) / step_;
  const double last = static_cast<double>(control_.size() - kTaps);
  const double piece = std::clamp(std::floor(place), 0.0, last);
  const double f = place - piece;
  const auto start = static_cast<std::size_t>(piece);
  Value sum{Vector6::Zero(), Vector6::Zero(), Vector6::Zero()};
  for (std::size_t j = 0; j < kTaps; ++j) {
    const auto& c = kPowers[j];
    double value = 0.0, rate = 0.0, change = 0.0;
    for (std::size_t k = kTaps; k-- > 0;) {
      change = change * f + 2.0 * rate;
      rate = rate * f + value;
      value = value * f + c[k];
    }
    sum.value += value / 120.0 * control_[start + j];
    sum.rate += rate / 120.0 / step_ * control_[start + j];
    sum.change += change / 120.0 / (step_ * step_) * control_[start + j];
  }
  return sum;
}

}  // namespace urban_nav_sim
