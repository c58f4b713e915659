// SPDX-License-Identifier: BSD-3-Clause
#include "window/drift_sandwich.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::Matrix6d;
using urban_nav_core::SmallCholesky;

namespace {

// A landmark lives for the time in which the view changes by half a radian or so: a score of generations.
constexpr double memory_rad = 10.0;
// Effective clusters that the model counts for.
constexpr double model_clusters = 20.0;

std::array<double, 2> traces(const Matrix6d& A) {
  return {A.topLeftCorner<3, 3>().trace(), A.bottomRightCorner<3, 3>().trace()};
}

}  // namespace

void DriftSandwich::advance(double view_change) {
  const double kept = std::exp(-view_change / memory_rad);
  view_change_ = kept * view_change_ + view_change;
  information_ *= kept;
  expected_ *= kept;
  squares_ *= kept;
}

void DriftSandwich::add(const DriftScore& landmark) {
  if (!(landmark.life > 0.0) || !(view_change_ > 0.0)) return;
  const Matrix6d& I = landmark.information;
  // The others' information on a drift that is steady for as long as this landmark lived, and its own.
  const SmallCholesky<6> all(landmark.life / view_change_ * information_ + I);
  information_ += I;
  squares_ += landmark.score * landmark.score.transpose();
  if (all.succeeded()) expected_ += I - I * all.solve(I);
  const SmallCholesky<6> gain(information_);
  if (!gain.succeeded()) return;
  const Matrix6d D = gain.inverse();
  const std::array<double, 2> own = traces(D * I * D), total = traces(D);
  for (std::size_t part = 0; part < 2; ++part) {
    const double share = std::clamp(own[part] / total[part], 0.0, 1.0);
    squared_shares_[part] = (1.0 - share) * (1.0 - share) * squared_shares_[part] + share * share;
  }
}

double DriftSandwich::clusters(std::size_t part) const { return 1.0 / squared_shares_[part]; }

DriftSandwich::Ratio DriftSandwich::ratio() const {
  const SmallCholesky<6> gain(information_);
  if (!gain.succeeded()) return {};
  const Matrix6d D = gain.inverse();
  const std::array<double, 2> measured = traces(D * squares_ * D), expected = traces(D * expected_ * D);
  std::array<double, 2> ratios = {1.0, 1.0};
  for (std::size_t part = 0; part < 2; ++part) {
    const double ratio = measured[part] / expected[part], weight = clusters(part);
    if (std::isfinite(ratio)) ratios[part] = (model_clusters + weight * ratio) / (model_clusters + weight);
  }
  return {ratios[0], ratios[1]};
}

void DriftSandwich::archive(urban_nav_core::Archive& archive) {
  archive(view_change_, information_, expected_, squares_, squared_shares_);
  for (const double share : squared_shares_) archive.require(share > 0.0 && share <= 1.0, "shares of landmarks");
}

}  // namespace swf_vo
