// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/closure_comparison.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;

namespace {

/// Returns the squared Mahalanobis distance, with odometry's standard deviations multiplied by `scale`; nullopt if the
/// covariance is not positive definite.
std::optional<double> squaredDistance(const ClosureDifference& closure, double scale) {
  const Eigen::LLT<Eigen::MatrixXd> factor(scale * scale * closure.odometry + closure.closure);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const double distance = closure.difference.dot(factor.solve(closure.difference));
  return std::isfinite(distance) ? std::optional(distance) : std::nullopt;
}

struct Compared {
  const ClosureDifference* closure = nullptr;
  double squared_distance = 0.0, p_value = 1.0;
  double perAxis() const { return squared_distance / static_cast<double>(closure->difference.size()); }
};

std::optional<Compared> compare(const ClosureDifference& closure) {
  if (closure.difference.size() == 0 || !closure.difference.allFinite()) return std::nullopt;
  const std::optional<double> as_stated = squaredDistance(closure, 1.0);
  if (!as_stated) return std::nullopt;
  double tail = 0.0;
  for (const double scale : covarianceScales())
    tail += 1.0 - urban_nav_core::chiSquareProbability(squaredDistance(closure, scale).value_or(0.0),
                                                       static_cast<double>(closure.difference.size()));
  return Compared{&closure, *as_stated, tail / static_cast<double>(kScaleCount)};
}

void testKind(const std::vector<ClosureDifference>& closures, bool by_laser, TestResults& results) {
  const char* name = by_laser ? kLaserClosureTest : kStereoClosureTest;
  std::vector<Compared> compared;
  for (const ClosureDifference& closure : closures)
    if (closure.by_laser == by_laser)
      if (const std::optional<Compared> each = compare(closure)) compared.push_back(*each);
  if (compared.empty()) {
    const std::string by = by_laser ? "the lasers" : "stereo";
    results.absent.push_back({name, "no accepted closure by " + by + " between two moments of the session"});
    return;
  }
  std::sort(compared.begin(), compared.end(),
            [](const Compared& a, const Compared& b) { return a.perAxis() < b.perAxis(); });
  const ClosureDifference& median = *compared[compared.size() / 2].closure;
  ScaleEvidence evidence;
  evidence.add(median.difference, median.odometry, median.closure);
  results.turns.add(evidence);
  if (by_laser) results.lengths.add(evidence);
  const Compared& worst = *std::min_element(compared.begin(), compared.end(),
                                            [](const Compared& a, const Compared& b) { return a.p_value < b.p_value; });
  ConsistencyTest test;
  test.name = name;
  test.interval = worst.closure->interval;
  test.statistic = worst.squared_distance;
  test.degrees_of_freedom = static_cast<double>(worst.closure->difference.size());
  test.p_value = std::min(1.0, static_cast<double>(compared.size()) * worst.p_value);
  test.sentence = std::string("Closures by ") + (by_laser ? "lasers (" : "stereo (") + std::to_string(compared.size()) +
                  ") differ from odometry by up to " + formatNumber(worst.closure->distance_m) + " m and " +
                  formatNumber(worst.closure->angle_rad * 180.0 / M_PI) + " deg, " +
                  formatNumber(std::sqrt(worst.perAxis()), 3) + " times the stated standard deviation.";
  test.remedy =
      "Odometry drifts more than its covariance states, or a closure is false: check the calibration of the stereo "
      "pair, and the closures with `urban_nav why`.";
  results.tests.push_back(std::move(test));
}

}  // namespace

void testClosures(const std::vector<ClosureDifference>& closures, TestResults& results) {
  testKind(closures, false, results);
  testKind(closures, true, results);
}

void testPlanes(const std::vector<ClosureDifference>& planes, const char* absent_reason, TestResults& results) {
  std::vector<Compared> compared;
  for (const ClosureDifference& each : planes)
    if (const std::optional<Compared> one = compare(each)) compared.push_back(*one);
  if (compared.empty()) {
    results.absent.push_back({kPassTest, absent_reason});
    return;
  }
  std::sort(compared.begin(), compared.end(),
            [](const Compared& a, const Compared& b) { return a.p_value < b.p_value; });
  const std::size_t middle = compared.size() / 2;
  const Compared& median = compared[middle];
  const auto count = static_cast<double>(compared.size());
  ConsistencyTest test;
  test.name = kPassTest;
  test.interval = median.closure->interval;
  test.statistic = median.squared_distance;
  test.degrees_of_freedom = static_cast<double>(median.closure->difference.size());
  test.p_value = std::min(1.0, count / static_cast<double>(middle + 1) * median.p_value);
  test.sentence = "Planes that the lasers measured in two passes (" + std::to_string(compared.size()) +
                  " constraints) differ from odometry by " + formatNumber(median.closure->distance_m) + " m and " +
                  formatNumber(median.closure->angle_rad * 180.0 / M_PI) + " deg in the median, " +
                  formatNumber(std::sqrt(median.perAxis()), 3) + " times the stated standard deviation.";
  test.remedy =
      "The passes do not fit together: odometry drifts more than its covariance states, or a laser has moved on its "
      "mount between them. Inspect the walls in the map, and check the calibration of the stereo pair and of the "
      "lasers (`urban_nav map --calibrate`).";
  results.tests.push_back(std::move(test));
}

}  // namespace urban_nav_trust
