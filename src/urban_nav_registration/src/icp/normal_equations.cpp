// SPDX-License-Identifier: BSD-3-Clause
#include "icp/normal_equations.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_registration {

namespace {
constexpr std::size_t kGrain = 512;  // fixed: the partition affects the rounding
}

void Matcher::match(const Pose& T_target_source, std::vector<Match>& matches) {
  matches.resize(source_.size());
  held_.resize(source_.size());
  const Eigen::Matrix3f R = T_target_source.R().cast<float>();
  const Eigen::Vector3f t = T_target_source.t().cast<float>();
  urban_nav_core::forEach(source_.size(), kGrain, [&](std::size_t i) {
    const Surfel& surfel = source_[i];
    Match& match = matches[i];
    match.weight = 0.0;
    if (!(surfel.planarity > 0.0F)) return;
    const Eigen::Vector3f lever = R * surfel.mean, normal = R * surfel.normal, point = lever + t;
    Held& held = held_[i];
    if (held.nearest.surfel == nullptr ||
        !((point - held.point).squaredNorm() < held.nearest.margin * held.nearest.margin))
      held = {target_.nearest(point, normal), point};
    const Surfel* plane = held.nearest.surfel;
    if (plane == nullptr) return;
    match.lever = lever.cast<double>();
    match.target_normal = plane->normal.cast<double>();
    match.source_normal = (plane->normal.dot(normal) < 0.0F ? Eigen::Vector3f(-normal) : normal).cast<double>();
    match.residual = static_cast<double>(plane->normal.dot(point - plane->mean));
    match.weight = static_cast<double>(surfel.planarity * plane->planarity);
  });
}

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  H += other.H;
  b += other.b;
  weight += other.weight;
  return *this;
}

namespace {
struct Term {
  const Match& match;
  double sigma;
};
NormalEquations& operator+=(NormalEquations& sum, const Term& term) {
  const Match& match = term.match;
  if (!(match.weight > 0.0)) return sum;
  const double ratio = match.residual / term.sigma, square = 1.0 + ratio * ratio;
  const Vector6d row = planeJacobian(match.lever, match.target_normal);
  const double weight = match.weight / square;
  const Vector6d weighted = weight * row;
  for (int c = 0; c < 6; ++c)
    for (int r = c; r < 6; ++r) sum.H(r, c) += weighted[r] * row[c];
  sum.b += weighted * match.residual;
  sum.weight += match.weight;
  return sum;
}
}  // namespace

NormalEquations sumUp(const std::vector<Match>& matches, double sigma) {
  NormalEquations total = urban_nav_core::sumInOrder(matches.size(), kGrain, NormalEquations{}, [&](std::size_t i) {
    return Term{matches[i], sigma};
  });
  total.H.triangularView<Eigen::StrictlyUpper>() = total.H.transpose();
  return total;
}

double computeSpread(const std::vector<Match>& matches) {
  std::vector<std::pair<double, double>> sizes;
  sizes.reserve(matches.size());
  double sum = 0.0;
  for (const Match& match : matches) {
    if (!(match.weight > 0.0)) continue;
    sizes.emplace_back(std::abs(match.residual), match.weight);
    sum += match.weight;
  }
  // Weighted median by bisection. Equal sizes have equal values, so the order within the halves affects only the
  // rounding of their sums, and nth_element is deterministic.
  auto begin = sizes.begin(), end = sizes.end();
  double below = 0.0;  // weight before `begin`
  while (end - begin > 1) {
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [](const auto& a, const auto& b) { return a.first < b.first; });
    double first = 0.0;
    for (auto it = begin; it != middle; ++it) first += it->second;
    if (2.0 * (below + first) >= sum) {
      end = middle;
    } else {
      below += first;
      begin = middle;
    }
  }
  return begin == sizes.end() ? 0.0 : 1.4826 * begin->first;
}

}  // namespace urban_nav_registration
