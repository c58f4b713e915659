// SPDX-License-Identifier: BSD-3-Clause
#include "window/offset_sandwich.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::SmallCholesky;
using urban_nav_core::Vector6d;

namespace {

constexpr double kPriorClusters = 4.0;
// Limits of the ratio.
constexpr double kLeastRatio = 1e-2;
constexpr double kLargestRatio = 1e6;

}  // namespace

OffsetSandwich::Region& OffsetSandwich::find(const Eigen::Vector2d& direction) {
  const ImageRegion here = imageRegion(direction);
  const auto found =
      std::find_if(regions_.begin(), regions_.end(), [&](const Region& region) { return region.place == here; });
  if (found != regions_.end()) return *found;
  regions_.emplace_back();
  regions_.back().place = here;
  return regions_.back();
}

void OffsetSandwich::advance(double view_change) {
  const double kept = std::exp(-view_change / kScoreMemoryRad),
               correlated = std::exp(-view_change / kScoreCorrelationRad);
  drift_ *= kept;
  cross_ *= kept;
  for (Region& region : regions_) {
    region.score *= correlated;
    region.share *= correlated;
  }
}

void OffsetSandwich::add(const DriftScore& landmark) {
  if (!(landmark.life > 0.0)) return;
  drift_ += landmark.information;
  cross_ += landmark.offset_cross;
  const SmallCholesky<6> drift(drift_);
  if (!drift.succeeded()) return;
  const Vector6d A = drift.solve(cross_);
  if (!A.allFinite()) return;
  const double s = landmark.offset_score - A.dot(landmark.score),
               i = landmark.offset_information - 2.0 * A.dot(landmark.offset_cross) + A.dot(landmark.information * A);
  if (!(i > 0.0) || !std::isfinite(s)) return;
  Region& region = find(landmark.direction);
  squares_ += s * (s + 2.0 * region.score);
  information_ += i;
  region.score += s;
  const double share = i / information_, others = 1.0 - share;
  squared_shares_ = others * others * squared_shares_ + share * (share + 2.0 * others * region.share);
  for (Region& each : regions_) each.share *= others;
  region.share += share;
}

double OffsetSandwich::ratio(double without) const {
  if (!(information_ > 0.0) || !(squares_ > 0.0)) return without;
  const double clusters = 1.0 / squared_shares_,
               measured = std::clamp(squares_ / information_, kLeastRatio, kLargestRatio);
  return std::exp((kPriorClusters * std::log(without) + clusters * std::log(measured)) / (kPriorClusters + clusters));
}

void OffsetSandwich::Region::archive(urban_nav_core::Archive& archive) { archive(place, score, share); }

void OffsetSandwich::archive(urban_nav_core::Archive& archive) {
  archive(drift_, cross_, information_, squares_, squared_shares_, regions_);
  archive.require(squared_shares_ > 0.0, "invalid cluster shares");
}

}  // namespace swf_vo
