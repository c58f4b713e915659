// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/chi_square.hpp"

#include <cassert>
#include <cmath>

namespace urban_nav_core {
namespace {

constexpr int kTerms = 100000;
constexpr double kEnd = 1e-16;

double logGamma(double a) {
  int sign = 0;
  return ::lgamma_r(a, &sign);  // std::lgamma writes a global
}

// Regularised lower incomplete gamma function by its series, for x < a + 1 (Abramowitz and Stegun 6.5.29).
double lowerSeries(double a, double x) {
  double term = 1.0 / a, sum = term;
  for (int n = 1; n < kTerms && term > kEnd * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - logGamma(a));
}

// Its complement by the continued fraction, for x >= a + 1 (6.5.31), evaluated by Lentz's method.
double upperFraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, product = d;
  for (int n = 1; n < kTerms; ++n) {
    const double numerator = -n * (n - a);
    b += 2.0;
    d = numerator * d + b;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    c = b + numerator / c;
    if (std::abs(c) < kTiny) c = kTiny;
    product *= d * c;
    if (std::abs(d * c - 1.0) < kEnd * 4.0) break;
  }
  return product * std::exp(a * std::log(x) - x - logGamma(a));
}

}  // namespace

double chiSquareProbability(double x, double dof) {
  assert(dof > 0.0);
  if (!(x > 0.0)) return 0.0;
  const double a = 0.5 * dof, half = 0.5 * x;
  return half < a + 1.0 ? lowerSeries(a, half) : 1.0 - upperFraction(a, half);
}

double chiSquareQuantile(double probability, double dof) {
  assert(probability > 0.0 && probability < 1.0);
  double low = 0.0, high = dof + 1.0;
  while (chiSquareProbability(high, dof) < probability) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chiSquareProbability(middle, dof) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Band chiSquareMeanBand(double dof, double count, double probability) {
  const double tail = 0.5 * (1.0 - probability);
  return {chiSquareQuantile(tail, dof * count) / count, chiSquareQuantile(1.0 - tail, dof * count) / count};
}

}  // namespace urban_nav_core
