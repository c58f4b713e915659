// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/shared_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;

namespace {

constexpr double kLeastCloudShare = 1e-3;  // limits the repetition of information by a standing robot

bool isOfClouds(const MetricClosure& closure) {
  return closure.verdict == ClosureVerdict::Accepted && closure.method == ClosureMethod::Icp;
}

/// Returns the distance from the cloud around `x` to that around `y` along the path, in lengths of a cloud; nullopt if
/// they do not overlap.
std::optional<double> shift(const PoseRef& x, const PoseRef& y, const PlaceData& place_data, double length) {
  const auto path = place_data.between(x, y);
  if (!path || !(path->length < length)) return std::nullopt;
  return (y.stamp < x.stamp ? -1.0 : 1.0) * path->length / length;
}

/// Shift of a unit square relative to another one that it overlaps.
struct Shift {
  double at_a, at_b;
};

/// Returns whether a shift is already in the list, which is the case for a standing robot.
bool isAmong(const std::vector<Shift>& covered, const Shift& shift) {
  constexpr double kSame = 1e-3;
  return std::any_of(covered.begin(), covered.end(), [&](const Shift& other) {
    return std::abs(other.at_a - shift.at_a) < kSame && std::abs(other.at_b - shift.at_b) < kSame;
  });
}

/// Returns the share of the unit square not covered by the shifted ones.
double uncovered(const std::vector<Shift>& others) {
  std::vector<double> edges{0.0, 1.0};
  for (const Shift& other : others) edges.push_back(other.at_a < 0.0 ? 1.0 + other.at_a : other.at_a);
  std::sort(edges.begin(), edges.end());
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double middle = 0.5 * (edges[i] + edges[i + 1]);
    double below = 0.0,
           above = 0.0;  // all that is covered of this strip hangs on one of its ends: the squares are equal
    for (const Shift& other : others) {
      if (std::abs(middle - 0.5 - other.at_a) > 0.5) continue;
      if (other.at_b <= 0.0) below = std::max(below, 1.0 + other.at_b);
      if (other.at_b >= 0.0) above = std::max(above, 1.0 - other.at_b);
    }
    area += (edges[i + 1] - edges[i]) * std::max(0.0, 1.0 - below - above);
  }
  return area;
}

}  // namespace

void discountSharedClouds(std::vector<MetricClosure>& closures, const PlaceData& place_data,
                          const Parameters& parameters) {
  const double length = 2.0 * parameters.registration.cloud_half_length;
  // Share of the cloud around one pose that is in the cloud around the other.
  const auto common = [&](const PoseRef& x, const PoseRef& y) {
    const auto shifted = shift(x, y, place_data, length);
    return shifted ? 1.0 - std::abs(*shifted) : 0.0;
  };
  std::vector<std::size_t> of_clouds;
  for (std::size_t i = 0; i < closures.size(); ++i)
    if (isOfClouds(closures[i])) of_clouds.push_back(i);
  std::vector<double> sharing(of_clouds.size(), 1.0);
  for (std::size_t i = 0; i < of_clouds.size(); ++i)
    for (std::size_t j = i + 1; j < of_clouds.size(); ++j) {
      const MetricClosure &one = closures[of_clouds[i]], &other = closures[of_clouds[j]];
      const double both =
          std::max(common(one.a, other.a) * common(one.b, other.b), common(one.a, other.b) * common(one.b, other.a));
      sharing[i] += both;
      sharing[j] += both;
    }
  for (std::size_t i = 0; i < of_clouds.size(); ++i) closures[of_clouds[i]].measured.information /= sharing[i];
}

void discountAgainst(MetricClosure& closure, const std::vector<MetricClosure>& earlier, const PlaceData& place_data,
                     const Parameters& parameters) {
  if (!isOfClouds(closure)) return;
  const double length = 2.0 * parameters.registration.cloud_half_length;
  std::vector<Shift> covered;
  for (const MetricClosure& each : earlier) {
    if (!isOfClouds(each)) continue;
    for (const auto& [a, b] : {std::pair(&each.a, &each.b), std::pair(&each.b, &each.a)}) {
      const auto at_a = shift(closure.a, *a, place_data, length), at_b = shift(closure.b, *b, place_data, length);
      if (at_a && at_b && !isAmong(covered, {*at_a, *at_b})) covered.push_back({*at_a, *at_b});
    }
  }
  closure.measured.information *= std::max(uncovered(covered), kLeastCloudShare);
}

}  // namespace loop_metric
