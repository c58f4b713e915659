// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Share of right answers among those that are not unsure, unless another is chosen.
constexpr double kStandardPrecision = 0.98;

/// Wrong answers by the least probability of a sure answer, from cross-validation by site: sites are held out as a
/// whole. Empty in models of version 3 and earlier, and in models of a single site.
class SureThresholds {
 public:
  /// Result of one threshold in cross-validation.
  struct Row {
    float least = 0.0F;     ///< probability of an answer from which it is sure
    float wrong = 0.0F;     ///< share of wrong answers among the sure ones, plus its standard error over the sites
    float answered = 0.0F;  ///< share of returns with a sure answer
  };

  SureThresholds() = default;
  /// `rows`: ascending by `least`.
  explicit SureThresholds(std::vector<Row> rows) : rows_(std::move(rows)) {}

  bool empty() const { return rows_.empty(); }
  const std::vector<Row>& rows() const { return rows_; }
  /// Returns the smallest threshold that keeps a share `precision` of the sure answers right. If none does, that with
  /// the fewest wrong answers which still answers a quarter of the returns. Requires rows.
  const Row& rowFor(double precision) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<Row> rows_;
};

/// Returns a sentence for the user on thresholds that differ from what was asked for: the fixed ones of a model without
/// thresholds, or a precision that cross-validation did not reach; empty for others. `model`: its name.
std::string thresholdNote(const SureThresholds& thresholds, double precision, const std::string& model);

}  // namespace scene_labeler
