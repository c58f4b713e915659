// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/teach/unit_kinds.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav {
namespace {

constexpr std::size_t kMostKinds = 48;  // a few times the 20 corrections of a session, so that none hides another
constexpr int kRounds = 8;              // of k-means: later ones move few units

}  // namespace

UnitKinds::UnitKinds(const TeachUnits& units, const scene_labeler::FeatureTable& features,
                     const scene_labeler::FeatureBins& bins)
    : columns_(features.columns()) {
  kind_of_.assign(units.size(), 0);
  distances_.assign(units.size(), 0.0F);
  if (units.size() == 0) return;
  describe(units, features, bins);
  seed(units);
  for (int round = 0; round < kRounds; ++round) {
    assign();
    moveMeans(units);
  }
  assign();
}

void UnitKinds::describe(const TeachUnits& units, const scene_labeler::FeatureTable& features,
                         const scene_labeler::FeatureBins& bins) {
  values_.assign(units.size() * columns_, 0.0F);
  urban_nav_core::forEach(units.size(), 64, [&](std::size_t unit) {
    const std::vector<std::uint32_t> members = units.members(static_cast<std::uint32_t>(unit));
    float* mean = values_.data() + unit * columns_;
    for (const std::uint32_t point : members)
      for (std::size_t column = 0; column < columns_; ++column)
        mean[column] += static_cast<float>(bins.code(column, features.row(point)[column]));
    for (std::size_t column = 0; column < columns_; ++column) mean[column] /= static_cast<float>(members.size());
  });
}

float UnitKinds::squaredDistance(std::uint32_t unit, std::size_t kind) const {
  float sum = 0.0F;
  for (std::size_t column = 0; column < columns_; ++column) {
    const float d = values_[unit * columns_ + column] - means_[kind * columns_ + column];
    sum += d * d;
  }
  return sum;
}

void UnitKinds::seed(const TeachUnits& units) {
  std::mt19937_64 random(1);
  std::vector<double> weights(units.size());
  std::vector<float> nearest(units.size(), std::numeric_limits<float>::max());
  for (std::uint32_t unit = 0; unit < units.size(); ++unit) weights[unit] = static_cast<double>(units.area(unit));
  while (kinds_ < std::min(kMostKinds, units.size())) {
    double sum = 0.0;
    for (const double weight : weights) sum += weight;
    if (!(sum > 0.0)) return;  // all units have the same features
    double left = sum * (static_cast<double>(random() >> 11U) * 0x1p-53);
    std::size_t chosen = 0;
    while (chosen + 1 < weights.size() && (left -= weights[chosen]) >= 0.0) ++chosen;
    means_.insert(means_.end(), values_.begin() + static_cast<std::ptrdiff_t>(chosen * columns_),
                  values_.begin() + static_cast<std::ptrdiff_t>((chosen + 1) * columns_));
    ++kinds_;
    urban_nav_core::forEach(units.size(), 256, [&](std::size_t unit) {
      const auto number = static_cast<std::uint32_t>(unit);
      nearest[unit] = std::min(nearest[unit], squaredDistance(number, kinds_ - 1));
      weights[unit] = static_cast<double>(nearest[unit] * units.area(number));
    });
  }
}

void UnitKinds::assign() {
  urban_nav_core::forEach(kind_of_.size(), 256, [&](std::size_t unit) {
    const auto number = static_cast<std::uint32_t>(unit);
    float least = std::numeric_limits<float>::max();
    for (std::size_t kind = 0; kind < kinds_; ++kind) {
      const float distance = squaredDistance(number, kind);
      if (distance >= least) continue;
      least = distance;
      kind_of_[unit] = static_cast<std::uint32_t>(kind);
    }
    distances_[unit] = least;
  });
}

void UnitKinds::moveMeans(const TeachUnits& units) {
  std::vector<double> sums(kinds_ * columns_, 0.0), weights(kinds_, 0.0);
  for (std::uint32_t unit = 0; unit < kind_of_.size(); ++unit) {
    const double area = static_cast<double>(units.area(unit));
    weights[kind_of_[unit]] += area;
    for (std::size_t column = 0; column < columns_; ++column)
      sums[kind_of_[unit] * columns_ + column] += area * static_cast<double>(values_[unit * columns_ + column]);
  }
  for (std::size_t kind = 0; kind < kinds_; ++kind)
    for (std::size_t column = 0; column < columns_ && weights[kind] > 0.0; ++column)
      means_[kind * columns_ + column] = static_cast<float>(sums[kind * columns_ + column] / weights[kind]);
}

}  // namespace urban_nav
