// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "urban_nav_core/io/closures_csv.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Verdict of the pose graph on a closure.
struct ClosureAssessment {
  std::int64_t id = 0;  ///< in the graph; 0: the closure is not part of it
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Rejected;
  std::string reason;
  double weight = 0.0;
};

// Closures of a run are urban_nav_core::MetricClosure from the beginning, with sessions by their names. A candidate is
// Waiting and has no information; a transform from a file is Accepted; a stage that measures adds evidence.

/// Returns a closure whose transform is not known yet. `source`: where it comes from, for messages.
urban_nav_core::MetricClosure toCandidate(const urban_nav_core::TopologicalClosure& closure, const std::string& source);

/// Appends the proposed closures to `closures` as candidates of `source`, except pairs that it has already.
void addProposed(const std::vector<urban_nav_core::TopologicalClosure>& proposed, const std::string& source,
                 std::vector<urban_nav_core::MetricClosure>& closures);

/// Returns the closure in a row of a file: a candidate, or with a transform one of independent errors on all axes. The
/// method stays as the file has it.
urban_nav_core::MetricClosure toMetricClosure(const urban_nav_core::ClosureRow& row);

/// Returns whether a stage has measured the closure: neither a candidate nor a transform from a file.
bool isMeasured(const urban_nav_core::MetricClosure& closure);

/// Returns the row of a closure before the pose graph: with the verdict of the stage that measured it, if one has.
urban_nav_core::ClosureRow toRow(const urban_nav_core::MetricClosure& closure);
/// Returns the row of a closure with the verdict of the pose graph, in which Waiting counts as Rejected.
urban_nav_core::ClosureRow toRow(const urban_nav_core::MetricClosure& closure, const ClosureAssessment& assessment);

/// Returns closures.csv. `assessments`: one for each closure, or none before the pose graph.
std::string printClosureRows(const std::vector<urban_nav_core::MetricClosure>& closures,
                             const std::vector<ClosureAssessment>& assessments);

/// Place of a closure in closures.csv: numbers of the session of b, its stamp, those of a, and the method.
using ClosurePlace = std::tuple<std::size_t, urban_nav_core::StampNs, std::size_t, urban_nav_core::StampNs, int>;
ClosurePlace closurePlace(const std::vector<std::string>& names, const urban_nav_core::PoseRef& a,
                          const urban_nav_core::PoseRef& b, urban_nav_core::ClosureMethod method);

/// Sorts closures, and with them their assessments, as closures.csv has them: by the session and time of b, then of a,
/// sessions in the order of `names`. Closures between sessions without a name come last.
void sortClosures(const std::vector<std::string>& names, std::vector<urban_nav_core::MetricClosure>& closures,
                  std::vector<ClosureAssessment>& assessments);

}  // namespace urban_nav
