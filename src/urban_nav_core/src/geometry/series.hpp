// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

/// The quotients of trigonometric functions in the Jacobians of SO(3) and SE(3). Each is a difference of nearly equal
/// numbers at small angles, where its Taylor series is used instead; the limits are where both are exact to about
/// 1e-13.
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

/// (a^2 / 2 - 1 + cos a) / a^4.
inline double cosineRest(double a) {
  constexpr double kTaylor[] = {1.0 / 24.0,       -1.0 / 720.0,      1.0 / 40320.0,
                                -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0};
  const double a2 = a * a;
  return std::abs(a) < 0.8 ? polynomial(kTaylor, a2) : (0.5 * a2 - 1.0 + std::cos(a)) / (a2 * a2);
}

/// (2 a - 3 sin a + a cos a) / (2 a^5).
inline double mixedRest(double a) {
  constexpr double kTaylor[] = {1.0 / 120.0,        -1.0 / 2520.0,         1.0 / 120960.0,        -1.0 / 9979200.0,
                                1.0 / 1245404160.0, -1.0 / 217945728000.0, 1.0 / 50812489728000.0};
  const double a2 = a * a;
  return std::abs(a) < 1.2 ? polynomial(kTaylor, a2)
                           : (2.0 * a - 3.0 * std::sin(a) + a * std::cos(a)) / (2.0 * a2 * a2 * a);
}

/// 1 / a^2 - cot(a / 2) / (2 a): finite up to a < 2 pi.
inline double cotangentRest(double a) {
  constexpr double kTaylor[] = {1.0 / 12.0,      1.0 / 720.0,      1.0 / 30240.0,
                                1.0 / 1209600.0, 1.0 / 47900160.0, 691.0 / 1307674368000.0};
  return std::abs(a) < 0.3 ? polynomial(kTaylor, a * a) : 1.0 / (a * a) - 0.5 / (a * std::tan(0.5 * a));
}

}  // namespace urban_nav_core::series
