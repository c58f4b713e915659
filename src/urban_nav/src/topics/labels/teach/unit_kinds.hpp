// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/model/feature_bins.hpp"
#include "topics/labels/teach/teach_units.hpp"

namespace urban_nav {

/// Groups of units with similar features: a correction of one is likely to hold for the others. k-means (Lloyd 1982,
/// seeds of Arthur and Vassilvitskii 2007) on the mean codes of the features, units weighted by area. Deterministic for
/// any number of threads. Immutable after construction, hence thread-safe.
class UnitKinds {
 public:
  UnitKinds(const TeachUnits& units, const scene_labeler::FeatureTable& features,
            const scene_labeler::FeatureBins& bins);

  std::size_t size() const { return kinds_; }
  std::uint32_t kind(std::uint32_t unit) const { return kind_of_[unit]; }
  /// Returns the squared distance of a unit from the mean of its kind, in codes.
  float distance(std::uint32_t unit) const { return distances_[unit]; }

 private:
  void describe(const TeachUnits& units, const scene_labeler::FeatureTable& features,
                const scene_labeler::FeatureBins& bins);
  void seed(const TeachUnits& units);
  void assign();
  void moveMeans(const TeachUnits& units);
  float squaredDistance(std::uint32_t unit, std::size_t kind) const;

  std::size_t columns_ = 0, kinds_ = 0;
  std::vector<float> values_;  // per unit and column: mean code
  std::vector<float> means_;   // per kind and column
  std::vector<std::uint32_t> kind_of_;
  std::vector<float> distances_;
};

}  // namespace urban_nav
