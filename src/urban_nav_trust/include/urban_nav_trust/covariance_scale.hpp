// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace urban_nav_trust {

/// Number of factors that are distinguished.
constexpr std::size_t kScaleCount = 12;
/// A weight for each of them.
using ScaleWeights = std::array<double, kScaleCount>;

/// Returns the factors s by which all standard deviations of odometry may be too small: the middles of equal steps of
/// log s from 1 to 20. A priori each is as likely. Derivation: docs/derivations/trust.md.
const ScaleWeights& covarianceScales();

/// Evidence of comparisons on the factor s: the likelihood of their differences, which are normally distributed with
/// the covariance s^2 V + R, of which odometry states V and the other measurement R. Empty: nothing was compared.
class ScaleEvidence {
 public:
  /// Adds independent comparisons. `log_likelihoods`: for each of covarianceScales(), up to a constant.
  void add(const ScaleWeights& log_likelihoods);
  /// Adds one difference of any number of coordinates. Matrices: positive semidefinite, their sum definite; a
  /// difference that is not finite is ignored.
  void add(const Eigen::VectorXd& difference, const Eigen::MatrixXd& odometry, const Eigen::MatrixXd& other);
  void add(const ScaleEvidence& other);
  bool isEmpty() const { return is_empty_; }
  /// Returns the probabilities of the factors, which sum to one; the prior if it is empty.
  ScaleWeights probabilities() const;

 private:
  bool is_empty_ = true;
  ScaleWeights log_likelihoods_{};
};

/// Evidence of a sensor that measures in windows. A window differs with the variance s^2 v + r + f^2 on each of its
/// axes. f is what sound sensors differ by beyond noise: one number from 0 to its bound, unknown, over which the
/// likelihood is averaged. Not thread-safe.
class WindowEvidence {
 public:
  /// `floor`: bound of f, in the unit of the differences.
  explicit WindowEvidence(double floor) : floor_(floor) {}
  /// Adds a window. `squares`: sum over its axes of the squared difference; `odometry`, `other`: v and r of an axis.
  /// Ignored unless all are finite and odometry's is above 0. `unit`: length in which f counts, per unit of `squares`.
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

/// Returns the probability of a squared distance of at least x where odometry's share of the covariance is too small by
/// an unknown factor, by the prior. `tail(x / s^2)`: that probability for a covariance that is right.
template <typename Tail>
double probabilityUnderUnknownScale(double x, const Tail& tail) {
  double sum = 0.0;
  for (const double scale : covarianceScales()) sum += tail(x / (scale * scale));
  return sum / static_cast<double>(kScaleCount);
}

}  // namespace urban_nav_trust
