// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/evidence_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/io/format_number.hpp"

namespace loop_metric {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::formatNumber;
using urban_nav_registration::ClosureTest;

namespace {

constexpr int kTestDigits = 4;

/// Returns the relative difference of value and limit: 0 at the limit, at most 2; infinite for a value that is not
/// finite.
double distanceToLimit(const ClosureTest& test) {
  const double larger = std::max(std::abs(test.value), std::abs(test.threshold));
  if (!std::isfinite(larger)) return std::numeric_limits<double>::infinity();
  return larger > 0.0 ? std::abs(test.value - test.threshold) / larger : 0.0;
}

bool wasAccepted(const Evidence& evidence) {
  const auto passed = [](const ClosureTest& test) { return test.passed; };
  return std::any_of(evidence.tries.begin(), evidence.tries.end(),
                     [](const Evidence::Try& each) { return each.verdict != ClosureVerdict::Rejected; }) &&
         std::all_of(evidence.gate.begin(), evidence.gate.end(), passed);
}

std::string describeLines(const std::vector<ClosureTest>& tests) {
  std::string text;
  for (const ClosureTest& test : tests)
    text += std::string("    ") + (test.passed ? "passed" : "failed") + "  " + describe(test) + "\n";
  return text;
}

}  // namespace

std::string describe(const ClosureTest& test) {
  return test.name + " = " + formatNumber(test.value, kTestDigits) + " (" + (test.at_least ? ">= " : "<= ") +
         formatNumber(test.threshold, kTestDigits) + ")";
}

std::optional<ClosureTest> nearestTest(const Evidence& evidence) {
  const bool accepted = wasAccepted(evidence);
  std::optional<ClosureTest> nearest_passed, nearest_failed;
  const auto consider = [&](const std::vector<ClosureTest>& tests) {
    for (const ClosureTest& test : tests) {
      std::optional<ClosureTest>& nearest = test.passed ? nearest_passed : nearest_failed;
      if (!nearest || distanceToLimit(test) < distanceToLimit(*nearest)) nearest = test;
    }
  };
  for (const Evidence::Try& each : evidence.tries)
    if (!accepted || each.verdict != ClosureVerdict::Rejected) consider(each.tests);
  consider(evidence.gate);
  return accepted || !nearest_failed ? nearest_passed : nearest_failed;
}

std::string tryTitle(const Evidence& evidence, std::size_t number) {
  const std::string title =
      evidence.tries[number].method == urban_nav_core::ClosureMethod::Icp ? "Clouds of the lasers" : "Two views";
  if (evidence.tries.size() < 2) return title;
  return title + " (" + std::to_string(number + 1) + " of " + std::to_string(evidence.tries.size()) + " tries)";
}

std::string describe(const Evidence& evidence) {
  std::string text;
  for (std::size_t i = 0; i < evidence.tries.size(); ++i) {
    const Evidence::Try& each = evidence.tries[i];
    text += "  " + tryTitle(evidence, i) + ": " + toString(each.verdict) +
            (each.sentence.empty() ? "" : ": " + each.sentence) + "\n" + describeLines(each.tests);
  }
  if (!evidence.gate.empty()) text += "  " + std::string(kGateTitle) + ":\n" + describeLines(evidence.gate);
  return text;
}

}  // namespace loop_metric
