// SPDX-License-Identifier: BSD-3-Clause
#include "window/drift_sandwich.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::Matrix6d;
using urban_nav_core::SmallCholesky;
using urban_nav_core::Vector6d;

namespace {

// Weight of the model, in effective clusters: usual degrees of freedom of an uncertain variance.
constexpr double kModelClusters = 4.0;
// Minimum share of a score that remains after the estimate has followed it: below, the leverage is too uncertain to be
// corrected for.
constexpr double kLeastLeft = 0.2;

// Pivots below this share of a coordinate's information are rounding errors.
constexpr double kLeastRatePivot = 1e-8;

/// Returns the inverse; nullopt if a direction is almost undetermined.
std::optional<Matrix6d> invertWellKnown(const Matrix6d& information) {
  const SmallCholesky<6> cholesky(information);
  if (!cholesky.succeeded()) return std::nullopt;
  for (int i = 0; i < 6; ++i)
    if (!(cholesky.factor()(i, i) * cholesky.factor()(i, i) > kLeastRatePivot * information(i, i))) return std::nullopt;
  return cholesky.inverse();
}

std::array<double, 2> traces(const Matrix6d& A) {
  return {A.topLeftCorner<3, 3>().trace(), A.bottomRightCorner<3, 3>().trace()};
}

}  // namespace

DriftSandwich::Region& DriftSandwich::find(const Eigen::Vector2d& direction) {
  const ImageRegion here = imageRegion(direction);
  const auto found =
      std::find_if(regions_.begin(), regions_.end(), [&](const Region& region) { return region.place == here; });
  if (found != regions_.end()) return *found;
  regions_.emplace_back();
  regions_.back().place = here;
  return regions_.back();
}

void DriftSandwich::advance(double view_change) {
  const double kept = std::exp(-view_change / kScoreMemoryRad),
               correlated = std::exp(-view_change / kScoreCorrelationRad),
               overlapping = life_ > 0.0 ? std::exp(-view_change / life_) : 1.0;
  view_change_ = kept * view_change_ + view_change;
  information_ *= kept;
  expected_ *= kept;
  squares_ *= kept;
  for (Region& region : regions_) {
    region.score *= correlated;
    region.information *= correlated * overlapping;
    for (double& share : region.share) share *= correlated;
  }
}

void DriftSandwich::add(const DriftScore& landmark) {
  if (!(landmark.life > 0.0) || !(view_change_ > 0.0)) return;
  const Matrix6d& I = landmark.information;
  const Vector6d& g = landmark.score;
  Region& region = find(landmark.direction);
  // Information of the others on a drift constant over this landmark's life, plus its own; and on a drift that it
  // shares with earlier landmarks of its region.
  const SmallCholesky<6> own(landmark.life / view_change_ * information_ + I);
  const SmallCholesky<6> shared(life_ / view_change_ * information_ + I + region.information);
  const Matrix6d together = g * region.score.transpose();
  squares_ += g * g.transpose() + together + together.transpose();
  if (own.succeeded()) expected_ += I - I * own.solve(I);
  if (shared.succeeded()) {
    const Matrix6d both = I * shared.solve(region.information);
    expected_ -= both + both.transpose();
  }
  region.score += g;
  region.information += I;
  information_ += I;
  const std::optional<Matrix6d> gain = invertWellKnown(information_);
  if (!gain) return;
  const Matrix6d& D = *gain;
  life_ += std::clamp((D * I).trace() / 6.0, 0.0, 1.0) * (landmark.life - life_);
  const std::array<double, 2> part_own = traces(D * I * D), total = traces(D);
  for (std::size_t part = 0; part < 2; ++part) {
    const double share = std::clamp(part_own[part] / total[part], 0.0, 1.0), others = 1.0 - share;
    squared_shares_[part] =
        others * others * squared_shares_[part] + share * (share + 2.0 * others * region.share[part]);
    for (Region& each : regions_) each.share[part] *= others;
    region.share[part] += share;
  }
}

DriftSandwich::Ratio DriftSandwich::ratio() const {
  const std::optional<Matrix6d> gain = invertWellKnown(information_);
  if (!gain) return {};
  const Matrix6d& D = *gain;
  const std::array<double, 2> measured = traces(D * squares_ * D), expected = traces(D * expected_ * D),
                              all = traces(D);
  std::array<double, 2> ratios = {1.0, 1.0};
  for (std::size_t part = 0; part < 2; ++part) {
    const double ratio = measured[part] / std::max(expected[part], kLeastLeft * all[part]), weight = clusters(part);
    if (std::isfinite(ratio) && ratio > 0.0)
      ratios[part] = (kModelClusters + weight * ratio) / (kModelClusters + weight);
  }
  return {ratios[0], ratios[1]};
}

void DriftSandwich::Region::archive(urban_nav_core::Archive& archive) { archive(place, score, information, share); }

void DriftSandwich::archive(urban_nav_core::Archive& archive) {
  archive(view_change_, life_, information_, expected_, squares_, squared_shares_, regions_);
  for (const double share : squared_shares_) archive.require(share > 0.0, "invalid cluster shares");
}

}  // namespace swf_vo
