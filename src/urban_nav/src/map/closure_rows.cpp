// SPDX-License-Identifier: BSD-3-Clause
#include "map/closure_rows.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureRow;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;

namespace {

// Standard deviations of a transform without sigma in its file: five times those of closures by stereo (paper, section
// 4.1).
constexpr double kUnknownSigmaM = 0.25, kUnknownSigmaRad = 0.05;

}  // namespace

MetricClosure toCandidate(const urban_nav_core::TopologicalClosure& closure, const std::string& source) {
  MetricClosure made;
  made.a = closure.a;
  made.b = closure.b;
  made.probability = closure.probability;
  made.verdict = ClosureVerdict::Waiting;
  made.source = source;
  return made;
}

void addProposed(const std::vector<urban_nav_core::TopologicalClosure>& proposed, const std::string& source,
                 std::vector<urban_nav_core::MetricClosure>& closures) {
  std::set<std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>> known;
  for (const urban_nav_core::MetricClosure& closure : closures) known.insert(std::minmax(closure.a, closure.b));
  for (const urban_nav_core::TopologicalClosure& closure : proposed)
    if (known.insert(std::minmax(closure.a, closure.b)).second) closures.push_back(toCandidate(closure, source));
}

MetricClosure toMetricClosure(const ClosureRow& row) {
  MetricClosure made = toCandidate({row.a, row.b, row.probability}, row.where);
  made.method = row.method;
  if (!row.T_a_b) return made;
  made.verdict = ClosureVerdict::Accepted;
  made.measured.T_a_b = *row.T_a_b;
  const double sigma_m = row.sigma_m > 0.0 ? row.sigma_m : kUnknownSigmaM;
  const double sigma_rad = row.sigma_rad > 0.0 ? row.sigma_rad : kUnknownSigmaRad;
  made.measured.information.diagonal().head<3>().setConstant(1.0 / (sigma_m * sigma_m));
  made.measured.information.diagonal().tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
  return made;
}

bool isMeasured(const MetricClosure& closure) {
  return closure.verdict == ClosureVerdict::Rejected || !closure.evidence.empty();
}

ClosureRow toRow(const MetricClosure& closure) {
  ClosureRow row;
  row.a = closure.a;
  row.b = closure.b;
  row.probability = closure.probability;
  row.where = closure.source;
  if (closure.verdict != ClosureVerdict::Rejected) row.method = closure.method;
  if (closure.verdict == ClosureVerdict::Accepted) row.T_a_b = closure.measured.T_a_b;
  if (!isMeasured(closure)) return row;
  row.verdict = closure.verdict;
  if (closure.verdict != ClosureVerdict::Accepted) row.reason = closure.reason_name + ": " + closure.sentence;
  return row;
}

ClosureRow toRow(const MetricClosure& closure, const ClosureAssessment& assessment) {
  ClosureRow row = toRow(closure);
  row.verdict = assessment.verdict == ClosureVerdict::Accepted ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
  row.reason = assessment.reason;
  row.weight = assessment.weight;
  return row;
}

void sortClosures(const std::vector<std::string>& names, std::vector<MetricClosure>& closures,
                  std::vector<ClosureAssessment>& assessments) {
  std::vector<std::size_t> order(closures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const MetricClosure& closure = closures[i];
    return closurePlace(names, closure.a, closure.b, closure.method);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<MetricClosure> sorted;
  std::vector<ClosureAssessment> sorted_assessments;
  for (const std::size_t i : order) {
    sorted.push_back(closures[i]);
    if (i < assessments.size()) sorted_assessments.push_back(assessments[i]);
  }
  closures = std::move(sorted);
  assessments = std::move(sorted_assessments);
}

ClosurePlace closurePlace(const std::vector<std::string>& names, const urban_nav_core::PoseRef& a,
                          const urban_nav_core::PoseRef& b, ClosureMethod method) {
  const auto place = [&](const std::string& session) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), session) - names.begin());
  };
  return {place(b.session), b.stamp, place(a.session), a.stamp, static_cast<int>(method)};
}

std::string printClosureRows(const std::vector<MetricClosure>& closures,
                             const std::vector<ClosureAssessment>& assessments) {
  std::vector<ClosureRow> rows;
  for (std::size_t i = 0; i < closures.size(); ++i)
    rows.push_back(i < assessments.size() ? toRow(closures[i], assessments[i]) : toRow(closures[i]));
  return printClosures(rows);
}

}  // namespace urban_nav
