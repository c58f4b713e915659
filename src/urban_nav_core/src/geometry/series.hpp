// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

/// Quotients of trigonometric functions in the Jacobians of SO(3). At small angles each is a difference of nearly equal
/// numbers and is replaced by its Taylor series; at the thresholds both are exact to about 1e-13.
namespace urban_nav_core::series {

template <int N>
double polynomial(const double (&coefficients)[N], double x) {
  double sum = coefficients[N - 1];
  for (int i = N - 2; i >= 0; --i) sum = coefficients[i] + x * sum;
  return sum;
}

/// sin(a) / a.
inline double sinc(double a) { return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a; }

/// (a - sin a) / a^3.
inline double sineRest(double a) {
  constexpr double kTaylor[] = {1.0 / 6.0,       -1.0 / 120.0,     1.0 / 5040.0,
                                -1.0 / 362880.0, 1.0 / 39916800.0, -1.0 / 6227020800.0};
  return std::abs(a) < 0.7 ? polynomial(kTaylor, a * a) : (a - std::sin(a)) / (a * a * a);
}

/// 1 / a^2 - cot(a / 2) / (2 a): finite up to a < 2 pi.
inline double cotangentRest(double a) {
  constexpr double kTaylor[] = {1.0 / 12.0,      1.0 / 720.0,      1.0 / 30240.0,
                                1.0 / 1209600.0, 1.0 / 47900160.0, 691.0 / 1307674368000.0};
  return std::abs(a) < 0.3 ? polynomial(kTaylor, a * a) : 1.0 / (a * a) - 0.5 / (a * std::tan(0.5 * a));
}

}  // namespace urban_nav_core::series
