// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/position_probability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace urban_nav_trust {

namespace {

constexpr int kSteps = 24;     // even, of Simpson's rule over half of each axis
constexpr double kTail = 6.0;  // sigmas beyond which the density is neglected
constexpr double kSqrt2 = 1.4142135623730951;

/// Returns the integral of f(x) times the density of N(0, sigma^2) over |x| < h, f even.
template <typename Function>
double integrate(double h, double sigma, const Function& f) {
  if (!(sigma > 1e-9 * h)) return f(0.0);
  // The substitution x = h sin(a) removes the vertical tangent of f at the surface of the ball.
  const double reach = std::asin(std::min(1.0, kTail * sigma / h)), step = reach / kSteps;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = i * step, x = h * std::sin(a), u = x / sigma;
    const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * f(x) * std::exp(-0.5 * u * u) * h * std::cos(a);
  }
  return 2.0 * sum * step / 3.0 / (sigma * std::sqrt(2.0 * M_PI));
}

}  // namespace

double probabilityWithin(double radius, const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return 0.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d sigma = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const double probability = integrate(radius, sigma[0], [&](double x) {
    const double disc = std::sqrt(std::max(0.0, radius * radius - x * x));
    if (disc == 0.0) return 0.0;
    return integrate(disc, sigma[1], [&](double y) {
      const double chord = std::sqrt(std::max(0.0, disc * disc - y * y));
      return sigma[2] > 0.0 ? std::erf(chord / (kSqrt2 * sigma[2])) : 1.0;
    });
  });
  return std::clamp(probability, 0.0, 1.0);
}

}  // namespace urban_nav_trust
