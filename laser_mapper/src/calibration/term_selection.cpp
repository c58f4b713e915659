// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/term_selection.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace laser_mapper {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kDelay = 0.05, kShift = 0.05, kTurn = 0.05;  // s, m, rad: typical errors of careful manual calibration
constexpr double kConstrainedShare = 1.0 / 3.0;               // of the prior's standard deviation
constexpr double kSignificance = 0.999;
constexpr double kTogether = 0.5;  // correlation above which terms are reported together

/// Terms of one laser that are selected together.
struct Group {
  Index first = 0, size = 1;
};

std::vector<Group> groupsOf(Index terms) {
  std::vector<Group> groups;
  for (Index first = 0; first < terms; first += kCalibrationTerms)
    for (const Group& group : {Group{0, 1}, Group{1, 3}, Group{4, 3}})
      groups.push_back({first + group.first, group.size});
  return groups;
}

/// Gaussian of the terms of some groups given that all others are zero.
struct Conditional {
  VectorXd mean;
  MatrixXd covariance;
};

Conditional conditionOn(const TermEstimate& estimate, const MatrixXd& information, const std::vector<Group>& kept) {
  std::vector<Index> in;
  for (const Group& group : kept)
    for (Index i = 0; i < group.size; ++i) in.push_back(group.first + i);
  const auto n = static_cast<Index>(in.size());
  MatrixXd inner(n, n);
  VectorXd right(n);
  const VectorXd all = information * estimate.mean;
  for (Index r = 0; r < n; ++r) {
    right(r) = all(in[static_cast<std::size_t>(r)]);
    for (Index c = 0; c < n; ++c)
      inner(r, c) = information(in[static_cast<std::size_t>(r)], in[static_cast<std::size_t>(c)]);
  }
  const auto covariance = urban_nav_core::invertPositiveDefinite(inner);
  if (!covariance) return {VectorXd::Zero(n), MatrixXd::Identity(n, n)};
  return {*covariance * right, *covariance};
}

/// Returns the probability of a smaller estimate of the group by chance.
double significanceOf(const Conditional& conditional, Index first, Index size) {
  const VectorXd mean = conditional.mean.segment(first, size);
  const auto information =
      urban_nav_core::invertPositiveDefinite(conditional.covariance.block(first, first, size, size));
  if (!information) return 0.0;
  return urban_nav_core::chiSquareProbability(mean.dot(*information * mean), static_cast<double>(size));
}

std::string termName(Index term, const std::vector<MountedLaser>& lasers) {
  const MountedLaser& laser = lasers[static_cast<std::size_t>(term / kCalibrationTerms)];
  const Index own = term % kCalibrationTerms;
  if (own == 0) return "delay of " + laser.frame;
  const Index axis = (own - 1) % 3;
  const Eigen::Vector3d direction = laser.T_base_laser.R().col(axis);
  Index base_axis = 0;
  const double largest = direction.cwiseAbs().maxCoeff(&base_axis);
  const char* names[3] = {"forward", "left", "up"};
  const char* opposite[3] = {"backward", "right", "down"};
  const std::string towards =
      largest < 0.9 ? "" : std::string(" (") + (direction(base_axis) > 0.0 ? names : opposite)[base_axis] + ")";
  return std::string(own < 4 ? "shift of " : "turn of ") + laser.frame + (own < 4 ? " along its " : " about its ") +
         std::string(1, static_cast<char>('x' + axis)) + " axis" + towards;
}

}  // namespace

TermVector priorSigmas() {
  TermVector sigmas;
  sigmas << kDelay, kShift, kShift, kShift, kTurn, kTurn, kTurn;
  return sigmas;
}

bool TermEstimate::isConstrained(Index term) const {
  return sigma(term) < kConstrainedShare * priorSigmas()(term % kCalibrationTerms);
}

std::vector<bool> significantTerms(const TermEstimate& estimate) {
  std::vector<bool> significant(static_cast<std::size_t>(estimate.mean.size()), false);
  const auto information = urban_nav_core::invertPositiveDefinite(estimate.covariance);
  if (!information) return significant;
  std::vector<Group> kept = groupsOf(estimate.mean.size());
  while (!kept.empty()) {
    const Conditional conditional = conditionOn(estimate, *information, kept);
    std::size_t least = 0;
    double least_significance = 2.0;
    Index first = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double significance = significanceOf(conditional, first, kept[i].size);
      if (significance < least_significance) {
        least = i;
        least_significance = significance;
      }
      first += kept[i].size;
    }
    if (least_significance >= kSignificance) break;
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(least));
  }
  for (const Group& group : kept)
    for (Index i = 0; i < group.size; ++i) significant[static_cast<std::size_t>(group.first + i)] = true;
  return significant;
}

bool TermSelection::holdsAny() const {
  return std::find(significant.begin(), significant.end(), true) != significant.end();
}

DeviceCalibration TermSelection::device(std::size_t number, const std::string& frame, bool is_adopted) const {
  DeviceCalibration made;
  made.frame = frame;
  for (std::size_t t = 0; t < made.terms.size(); ++t) {
    const std::size_t term = kCalibrationTerms * number + t;
    const auto at = static_cast<Index>(term);
    const TermEstimate& from = significant[term] ? chosen : all;
    made.terms[t] = {from.mean(at), from.sigma(at), from.isConstrained(at),
                     significant[term] && is_adopted ? chosen.mean(at) : 0.0};
  }
  return made;
}

TermSelection selectTerms(std::size_t terms,
                          const std::function<TermEstimate(const std::vector<bool>& wanted)>& estimate) {
  TermSelection selection;
  selection.significant.assign(terms, false);
  selection.all = selection.chosen = estimate(std::vector<bool>(terms, true));
  if (selection.all.mean.size() == 0) return selection;
  selection.significant = significantTerms(selection.all);
  for (bool is_settled = !selection.holdsAny(); !is_settled;) {
    selection.chosen = estimate(selection.significant);
    if (selection.chosen.mean.size() == 0) selection.significant.assign(terms, false);
    is_settled = true;
    for (std::size_t term = 0; term < terms; ++term)  // remove terms that are not observable together with the others
      if (selection.significant[term] && !selection.chosen.isConstrained(static_cast<Index>(term)))
        selection.significant[term] = is_settled = false;
    is_settled = is_settled || !selection.holdsAny();
  }
  return selection;
}

std::vector<std::string> describeUnconstrained(const TermEstimate& estimate, const std::vector<MountedLaser>& lasers) {
  std::vector<std::string> sentences;
  for (Index term = 0; term < estimate.mean.size(); ++term) {
    if (estimate.isConstrained(term)) continue;
    std::string sentence = termName(term, lasers);
    if (estimate.conditional_sigma(term) < kConstrainedShare * priorSigmas()(term % kCalibrationTerms)) {
      std::string others;
      for (Index other = 0; other < estimate.mean.size(); ++other)
        if (other != term &&
            std::abs(estimate.covariance(term, other)) > kTogether * estimate.sigma(term) * estimate.sigma(other))
          others += (others.empty() ? "" : ", ") + termName(other, lasers);
      if (!others.empty()) sentence += ": only together with " + others;
    }
    sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace laser_mapper
