// SPDX-License-Identifier: BSD-3-Clause
#include "training/sure_validation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace scene_labeler {
namespace {

constexpr std::array<float, 17> kLeastProbabilities = {0.5F,  0.55F, 0.6F,  0.65F, 0.7F,  0.75F,  0.8F,   0.85F, 0.9F,
                                                       0.95F, 0.96F, 0.97F, 0.98F, 0.99F, 0.995F, 0.998F, 0.999F};

/// Weights of the returns of a site: all, and by threshold the sure ones and the wrong ones among these.
struct SiteCounts {
  double all = 0.0;
  std::array<double, kLeastProbabilities.size()> sure{}, wrong{};
};

SureThresholds::Row makeRow(const std::vector<SiteCounts>& sites, std::size_t t) {
  const auto count = static_cast<double>(sites.size());
  double sure = 0.0, wrong = 0.0;
  for (const SiteCounts& site : sites) {
    sure += site.sure[t] / site.all / count;
    wrong += site.wrong[t] / site.all / count;
  }
  if (!(sure > 0.0)) return {kLeastProbabilities[t], 1.0F, 0.0F};
  const double ratio = wrong / sure;
  double squares = 0.0;
  for (const SiteCounts& site : sites) {
    const double residual = (site.wrong[t] - ratio * site.sure[t]) / site.all;
    squares += residual * residual;
  }
  const double error = std::sqrt(squares / (count * (count - 1.0))) / sure;
  return {kLeastProbabilities[t], static_cast<float>(ratio + error), static_cast<float>(sure)};
}

}  // namespace

SureThresholds measureSureThresholds(const HeldOutPatches& held_out, const LabelModel& model) {
  const HeldOutScores fused = fusedAsByModel(held_out, model);
  std::map<std::uint16_t, SiteCounts> by_site;
  for (std::size_t i = 0; i < fused.size(); ++i) {
    const auto first = fused.scores.begin() + static_cast<std::ptrdiff_t>(i * fused.classes);
    const auto best = std::max_element(first, first + static_cast<std::ptrdiff_t>(fused.classes));
    const bool is_wrong = best - first != static_cast<std::ptrdiff_t>(fused.labels[i]);
    const auto weight = static_cast<double>(fused.weights[i]);
    SiteCounts& site = by_site[held_out.sites[i]];
    site.all += weight;
    for (std::size_t t = 0; t < kLeastProbabilities.size() && std::exp(*best) >= kLeastProbabilities[t]; ++t) {
      site.sure[t] += weight;
      site.wrong[t] += is_wrong ? weight : 0.0;
    }
  }
  std::vector<SiteCounts> sites;
  for (const auto& [number, site] : by_site)
    if (site.all > 0.0) sites.push_back(site);
  if (sites.size() < 2) return {};
  std::vector<SureThresholds::Row> rows;
  for (std::size_t t = 0; t < kLeastProbabilities.size(); ++t) rows.push_back(makeRow(sites, t));
  return SureThresholds(std::move(rows));
}

}  // namespace scene_labeler
