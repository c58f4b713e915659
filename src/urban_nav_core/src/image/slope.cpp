// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/slope.hpp"

#include <Eigen/LU>
#include <cmath>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_core {

namespace {

constexpr int kRounds = 12;
constexpr double kSettled = 1e-3;  // relative to the information of the prior

}  // namespace

void Slope::see(const Eigen::Vector2d& moment, const Eigen::Matrix2d& information) {
  moment_ += moment;
  information_ += 0.5 * (information + information.transpose());
}

Slope::Estimate Slope::under(double usual) const {
  // A Cauchy variable is Gaussian with information w ~ Gamma(1/2, usual^2 / 2); given a slope s, w is (1 + 2) /
  // (usual^2 + |s|^2).
  Estimate estimate;
  double w = 1.0 / (usual * usual);
  for (int round = 0; round < kRounds; ++round) {
    estimate.covariance = (information_ + w * Eigen::Matrix2d::Identity()).inverse();
    estimate.mean = estimate.covariance * moment_;
    const double next = 3.0 / (usual * usual + estimate.mean.squaredNorm() + estimate.covariance.trace());
    const bool done = std::abs(next - w) < kSettled * w;
    w = next;
    if (done) break;
  }
  return estimate;
}

Slope Slope::scaled(double factor) const {
  Slope made;
  made.moment_ = moment_ / factor;
  made.information_ = information_ / (factor * factor);
  return made;
}

void Slope::archive(Archive& archive) { archive(moment_, information_); }

}  // namespace urban_nav_core
