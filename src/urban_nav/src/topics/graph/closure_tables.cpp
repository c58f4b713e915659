// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/closure_tables.hpp"

#include <algorithm>

#include "loop_metric/evidence_text.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::formatNumber;
using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kMostRows = 500;  // closures in the tables

/// Returns seconds from the first pose of a session; the stamp for an unknown session.
std::string timeText(const GraphRun& graph, const std::string& session, StampNs stamp) {
  const pose_graph::Track* track = graph.graph.track(session);
  if (track == nullptr || track->stamps.empty()) return session + " " + urban_nav_core::printStamp(stamp);
  return session + " +" + formatNumber(urban_nav_core::secondsBetween(track->stamps.front(), stamp), 5);
}

/// Returns the evidence of the stage that measured a closure; empty if another one did.
loop_metric::Evidence readEvidence(const urban_nav_core::MetricClosure& closure) {
  const std::string_view text = loop_metric::evidenceIn(closure.evidence);
  return text.empty() ? loop_metric::Evidence() : loop_metric::parseEvidence(text);
}

std::string describeNearest(const loop_metric::Evidence& evidence) {
  const auto nearest = loop_metric::nearestTest(evidence);
  if (!nearest) return "";
  return (nearest->passed ? "" : "failed: ") + loop_metric::describe(*nearest);
}

std::string whyAnchor(std::int64_t number) { return "why-" + std::to_string(number); }

}  // namespace

std::vector<PageTable> closureTables(const GraphRun& graph) {
  PageTable verdicts{
      "Closures",
      {"closure", "from (s)", "to (s)", "probability", "kind", "verdict", "weight", "nearest test", "reason"},
      {},
      "Times in seconds from the first pose of the session; closures.csv has the stamps. The nearest "
      "test is the one that was nearest to the opposite result."};
  PageTable reasons{"Why",
                    {"closure", "tests"},
                    {},
                    "urban_nav why session.db --closure ID -o why.html shows the views and clouds of a closure."};
  if (graph.closures.size() > kMostRows)
    verdicts.caption += " The first " + std::to_string(kMostRows) + " of " + std::to_string(graph.closures.size()) +
                        " are listed; all are in closures.csv.";
  for (std::size_t i = 0; i < std::min(kMostRows, graph.closures.size()); ++i) {
    const urban_nav_core::ClosureRow row = toRow(graph.closures[i], graph.assessments[i]);
    const loop_metric::Evidence evidence = readEvidence(graph.closures[i]);
    const std::string tests = describe(evidence);
    const std::int64_t number = i < graph.numbers.size() ? graph.numbers[i] : 0;
    const std::string id = number > 0 ? std::to_string(number) : "";
    verdicts.rows.push_back({id, timeText(graph, row.a.session, row.a.stamp),
                             timeText(graph, row.b.session, row.b.stamp), formatNumber(row.probability, 3),
                             toString(row.method), toString(row.verdict.value()), formatNumber(row.weight, 3),
                             describeNearest(evidence), row.reason});
    verdicts.attributes.emplace_back();
    if (number == 0) continue;
    verdicts.attributes.back().edge = id;
    verdicts.attributes.back().link = "#" + whyAnchor(number);
    reasons.rows.push_back({id, tests.empty() ? "no evidence: it was given, or measured by another program" : tests});
    reasons.attributes.push_back({whyAnchor(number), "", ""});
  }
  std::vector<PageTable> tables = {std::move(verdicts)};
  if (!reasons.rows.empty()) tables.push_back(std::move(reasons));
  return tables;
}

}  // namespace urban_nav
