// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace urban_nav_trust {

/// Number of discrete factors.
constexpr std::size_t kScaleCount = 12;
/// One weight per factor.
using ScaleWeights = std::array<double, kScaleCount>;

/// Returns the factors s by which all standard deviations of odometry may be too small: centres of equal intervals of
/// log s from 1 to 20. They are equally probable a priori. Derivation: docs/derivations/trust.md.
const ScaleWeights& covarianceScales();

/// Evidence on the factor s from comparisons: the likelihood of their differences, which are normally distributed with
/// the covariance s^2 V + R, where V is that of odometry and R that of the other measurement. Empty: nothing was
/// compared.
class ScaleEvidence {
 public:
  /// Adds independent comparisons. `log_likelihoods`: for each of covarianceScales(), up to a constant.
  void add(const ScaleWeights& log_likelihoods);
  /// Adds one difference of any dimension. Matrices must be positive semidefinite and their sum definite; a difference
  /// that is not finite is ignored.
  void add(const Eigen::VectorXd& difference, const Eigen::MatrixXd& odometry, const Eigen::MatrixXd& other);
  void add(const ScaleEvidence& other);
  bool isEmpty() const { return is_empty_; }
  /// Returns the probabilities of the factors, which sum to one; the prior without evidence.
  ScaleWeights probabilities() const;

 private:
  bool is_empty_ = true;
  ScaleWeights log_likelihoods_{};
};

/// Evidence from a sensor that is compared in windows. The difference in a window has the variance s^2 v + r + f^2 on
/// each axis, where f is the unknown systematic difference of sound sensors, between 0 and its bound, over which the
/// likelihood is averaged. Not thread-safe.
class WindowEvidence {
 public:
  /// `floor`: bound of f, in the unit of the differences.
  explicit WindowEvidence(double floor) : floor_(floor) {}
  /// Adds a window. `squares`: sum over its axes of the squared difference; `odometry`, `other`: v and r of an axis.
  /// Ignored unless all are finite and `odometry` is positive. `unit`: length of f per unit of `squares`.
  void add(double squares, double axes, double odometry, double other, double unit = 1.0);
  ScaleEvidence evidence() const;

 private:
  static constexpr std::size_t kFloors = 6;
  double floor_;
  bool is_empty_ = true;
  std::array<ScaleWeights, kFloors> log_likelihoods_{};
};

/// Returns the probabilities of the larger of two independent factors.
ScaleWeights largerScale(const ScaleWeights& a, const ScaleWeights& b);

/// Returns the probability of a squared distance of at least x if odometry's part of the covariance is too small by an
/// unknown factor with the prior. `tail(x / s^2)`: that probability for a consistent covariance.
template <typename Tail>
double probabilityUnderUnknownScale(double x, const Tail& tail) {
  double sum = 0.0;
  for (const double scale : covarianceScales()) sum += tail(x / (scale * scale));
  return sum / static_cast<double>(kScaleCount);
}

}  // namespace urban_nav_trust
