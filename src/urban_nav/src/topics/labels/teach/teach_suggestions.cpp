// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/teach/teach_suggestions.hpp"

#include <algorithm>

namespace urban_nav {

using scene_labeler::SceneClass;
using scene_labeler::SceneLabels;

namespace {

constexpr double kUnsureFactor = 0.5;  // of the probability of an unsure answer: about half of them are right in a
                                       // new place (docs/results/scene_labeler.md)

/// Mean probabilities of a unit's answers.
struct UnitAnswer {
  bool is_open = false;  // it has answers, and no correction
  std::size_t best = 0, second = 0;
  double probability = 0.0, unsure = 0.0;  // the latter: share of the points

  double uncertainty() const { return 1.0 - probability * (1.0 - (1.0 - kUnsureFactor) * unsure); }
};

UnitAnswer meanAnswer(const std::vector<std::uint32_t>& members, const SceneLabels& answer,
                      const std::vector<SceneClass>& corrected) {
  const std::size_t classes = answer.classes.size();
  std::vector<double> sums(classes, 0.0);
  double count = 0.0;
  UnitAnswer mean;
  for (const std::uint32_t point : members) {
    if (corrected[point] != SceneClass::None) return mean;
    if (answer.labels[point] == SceneClass::None) continue;
    count += 1.0;
    mean.unsure += answer.unsure[point];
    for (std::size_t k = 0; k < classes; ++k) sums[k] += static_cast<double>(answer.probabilities[point * classes + k]);
  }
  if (!(count > 0.0)) return mean;
  mean.is_open = true;
  mean.unsure /= count;
  mean.best = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  mean.probability = sums[mean.best] / count;
  sums[mean.best] = -1.0;
  mean.second = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  return mean;
}

/// Sums over the open units of a kind, and the most typical of them.
struct KindSum {
  std::size_t units = 0, corrections = 0;
  double area = 0.0, worth = 0.0;
  std::uint32_t typical = TeachUnits::kNone;
};

}  // namespace

std::vector<TeachSuggestion> suggestCorrections(const TeachUnits& units, const UnitKinds& kinds,
                                                const SceneLabels& answer,
                                                const std::vector<LabelCorrection>& corrections,
                                                const std::vector<SceneClass>& corrected, std::size_t most) {
  std::vector<KindSum> sums(kinds.size());
  std::vector<UnitAnswer> answers(units.size());
  for (const LabelCorrection& correction : corrections)
    if (const std::uint32_t unit = units.unit(correction.point); unit != TeachUnits::kNone)
      ++sums[kinds.kind(unit)].corrections;
  for (std::uint32_t unit = 0; unit < units.size(); ++unit) {
    answers[unit] = meanAnswer(units.members(unit), answer, corrected);
    if (!answers[unit].is_open) continue;
    KindSum& sum = sums[kinds.kind(unit)];
    const double area = static_cast<double>(units.area(unit));
    ++sum.units;
    sum.area += area;
    sum.worth += area * answers[unit].uncertainty();
    if (sum.typical == TeachUnits::kNone || kinds.distance(unit) < kinds.distance(sum.typical)) sum.typical = unit;
  }
  std::vector<TeachSuggestion> suggestions;
  for (const KindSum& sum : sums) {
    if (sum.typical == TeachUnits::kNone) continue;
    const UnitAnswer& its = answers[sum.typical];
    TeachSuggestion one;
    one.point = units.middle(sum.typical);
    one.units = sum.units;
    one.area = sum.area;
    one.worth = sum.worth / static_cast<double>(1 + sum.corrections);
    one.label = answer.classes[its.best];
    if (its.second != its.best) one.second = answer.classes[its.second];
    one.probability = its.probability;
    suggestions.push_back(one);
  }
  std::stable_sort(suggestions.begin(), suggestions.end(),
                   [](const TeachSuggestion& a, const TeachSuggestion& b) { return a.worth > b.worth; });
  if (suggestions.size() > most) suggestions.resize(most);
  return suggestions;
}

}  // namespace urban_nav
