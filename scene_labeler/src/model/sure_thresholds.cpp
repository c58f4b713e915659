// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/sure_thresholds.hpp"

#include <algorithm>

#include "urban_nav_core/io/format_number.hpp"

namespace scene_labeler {
namespace {

constexpr float kFewestAnswered = 0.25F;
constexpr std::size_t kMostThresholds = 100;

}  // namespace

const SureThresholds::Row& SureThresholds::rowFor(double precision) const {
  const Row* best = &rows_.front();
  for (const Row& row : rows_) {
    if (static_cast<double>(row.wrong) <= 1.0 - precision) return row;
    if (row.wrong < best->wrong && row.answered >= kFewestAnswered) best = &row;
  }
  return *best;
}

void SureThresholds::archive(urban_nav_core::Archive& archive) {
  std::vector<float> numbers;
  for (const Row& row : rows_) numbers.insert(numbers.end(), {row.least, row.wrong, row.answered});
  archive(numbers);
  if (!archive.isReading()) return;
  archive.require(numbers.size() % 3 == 0 && numbers.size() / 3 <= kMostThresholds, "its thresholds are incomplete");
  rows_.clear();
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Row row{numbers[i], numbers[i + 1], numbers[i + 2]};
    const bool is_sound = row.least > (rows_.empty() ? 0.0F : rows_.back().least) && row.least < 1.0F &&
                          row.wrong >= 0.0F && row.answered >= 0.0F;
    archive.require(is_sound, "its thresholds are not ascending probabilities");
    rows_.push_back(row);
  }
}

std::string thresholdNote(const SureThresholds& thresholds, double precision, const std::string& model) {
  using urban_nav_core::formatNumber;
  if (thresholds.empty())
    return model +
           " holds no thresholds for a precision (a model of an earlier version, or of a single site): labels are sure "
           "from a probability of 0.5, in unlike scenes 0.7, in new places and with another device 0.8; labels train "
           "--add MODEL -o NEW adds the thresholds";
  const SureThresholds::Row& row = thresholds.rowFor(precision);
  if (static_cast<double>(row.wrong) <= 1.0 - precision) return "";
  return "no threshold of " + model + " kept " + formatNumber(100.0 * precision, 3) +
         " % of the sure labels right in its cross-validation: labels are sure from a probability of " +
         formatNumber(static_cast<double>(row.least), 3) + ", where " +
         formatNumber(100.0 * static_cast<double>(row.wrong), 2) + " % were wrong";
}

}  // namespace scene_labeler
