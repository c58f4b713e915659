// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/explanation.hpp"

#include <cmath>
#include <map>

#include "base/plot.hpp"
#include "loop_metric/evidence_text.hpp"
#include "loop_metric/place/stored_place_data.hpp"
#include "map/previous_sessions.hpp"
#include "topics/loops/closure_picture.hpp"
#include "topics/loops/stored_sessions.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using loop_metric::Evidence;
using urban_nav_core::ClosureMethod;
using urban_nav_registration::ClosureTest;
using urban_nav_store::EdgeKind;

namespace {

constexpr double kExplainedDegrees = 57.29577951308232;
constexpr double kAngleWeight = 10.0;  // for display of free directions

std::string timeText(const std::string& name, double since, urban_nav_core::StampNs stamp) {
  return name + " +" + urban_nav_core::formatNumber(since, 6) + " s (" + urban_nav_core::printStamp(stamp) + ")";
}

std::string makeHeadline(const StoredClosure& closure) {
  const urban_nav_store::Edge& edge = closure.edge;
  return (closure.id == 0 ? "measurement" : "closure " + std::to_string(closure.id)) + ": " +
         timeText(closure.name_a, closure.since_a, edge.a.stamp) + " and " +
         timeText(closure.name_b, closure.since_b, edge.b.stamp);
}

std::string formatVerdict(const StoredClosure& closure) {
  const urban_nav_store::Edge& edge = closure.edge;
  std::string text = std::string(toString(edge.verdict));
  if (edge.verdict == urban_nav_core::ClosureVerdict::Accepted)
    text += ", by " + std::string(toString(edge.kind)) + ", weight " + urban_nav_core::formatNumber(edge.weight, 3);
  return edge.reason.empty() ? text : text + ": " + edge.reason;
}

/// Returns the measured transform as text; empty without a measurement.
std::string formatTransform(const StoredClosure& closure) {
  const urban_nav_core::Constraint& measured = closure.edge.measured;
  if (measured.information.isZero(0.0)) return {};
  const urban_nav_core::Matrix6d covariance = urban_nav_core::covarianceForDisplay(measured.information, kAngleWeight);
  const auto sigma = [&](int i) { return std::sqrt(covariance(i, i)); };
  const auto part = [&](int i, double value, double unit) {
    return urban_nav_core::formatNumber(unit * value, 4) +
           (sigma(i) > 1.0 ? " (free)" : " +- " + urban_nav_core::formatNumber(unit * sigma(i), 2));
  };
  const auto& t = measured.T_a_b.t();
  const urban_nav_core::Vector3d r = urban_nav_core::logSo3(measured.T_a_b.q());
  return "T_a_b: " + part(0, t.x(), 1) + ", " + part(1, t.y(), 1) + ", " + part(2, t.z(), 1) + " m; rotation vector " +
         part(3, r.x(), kExplainedDegrees) + ", " + part(4, r.y(), kExplainedDegrees) + ", " +
         part(5, r.z(), kExplainedDegrees) + " deg";
}

/// Returns the value required by a failed test.
std::string describeNeeded(const ClosureTest& test) {
  if (test.passed) return {};
  return std::string(test.at_least ? "at least " : "at most ") + urban_nav_core::formatNumber(test.threshold, 4);
}

std::vector<std::string> toRow(const ClosureTest& test) {
  return {test.name, urban_nav_core::formatNumber(test.value, 4),
          (test.at_least ? ">= " : "<= ") + urban_nav_core::formatNumber(test.threshold, 4),
          test.passed ? "passed" : "failed", describeNeeded(test)};
}

PageTable makeTable(const std::string& title, const std::vector<ClosureTest>& tests) {
  PageTable table{title, {"test", "value", "limit", "", "required"}, {}, ""};
  for (const ClosureTest& test : tests) table.rows.push_back(toRow(test));
  return table;
}

constexpr const char* kHowToReadViews =
    "Lines: matches, green inliers and red outliers; grey: features without a match.";
constexpr const char* kHowToReadClouds =
    "Laser points around the first moment (red) and the second (blue): placed by odometry, or centred on each other "
    "without it, and as aligned. Purple: coinciding points. Dots: positions of the robot.";
constexpr const char* kNoEvidence = "The store has no evidence for it: it was given, or measured by another program.";
constexpr const char* kPlaneEvidence =
    "Planes around both moments, measured by the lasers in two passes; quality.csv has the distance between the "
    "passes of each plane.";

std::string sentenceWithoutEvidence(const StoredClosure& closure) {
  return closure.edge.kind == urban_nav_store::EdgeKind::Plane ? kPlaneEvidence : kNoEvidence;
}

/// Returns the sessions of both moments by their names in the evidence.
std::vector<CandidateSession> namedIn(const StoredClosure& closure, const PreviousSessions& kept) {
  std::map<std::string, urban_nav_store::SessionId> ids;
  for (const Evidence::Try& each : closure.evidence.tries) {
    ids.emplace(each.keyframe_a.session, closure.edge.a.session);
    ids.emplace(each.keyframe_b.session, closure.edge.b.session);
  }
  std::vector<CandidateSession> sessions;
  for (const auto& [name, id] : ids)
    for (std::size_t i = 0; i < kept.ids.size(); ++i)
      if (kept.ids[i] == id) sessions.push_back({name, id, &kept.runs[i]});
  return sessions;
}

}  // namespace

std::string explain(const StoredClosure& closure) {
  std::string text = makeHeadline(closure) + "\n  " + formatVerdict(closure) + "\n";
  if (closure.probability)
    text +=
        "  probability that the places are the same: " + urban_nav_core::formatNumber(*closure.probability, 4) + "\n";
  if (const std::string transform = formatTransform(closure); !transform.empty()) text += "  " + transform + "\n";
  const Evidence& evidence = closure.evidence;
  text += describe(evidence);
  if (evidence.tries.empty() && evidence.gate.empty()) text += "  " + sentenceWithoutEvidence(closure) + "\n";
  return text;
}

Page explainOnPage(const StoredClosure& closure, urban_nav_store::Store& store, double cloud_half_length) {
  const PreviousSessions kept = readPreviousSessions(store, {});
  const loop_metric::StoredPlaceData place_data(storedSessions(namedIn(closure, kept), store, std::nullopt),
                                                store.keyframes(), store.scans());
  Page page;
  page.title = "Why: closure " + std::to_string(closure.id);
  page.subtitle = makeHeadline(closure);
  const bool accepted = closure.edge.verdict == urban_nav_core::ClosureVerdict::Accepted;
  page.verdicts.push_back({accepted ? Grade::Good : Grade::Bad, accepted ? "Accepted." : "Not accepted.",
                           formatVerdict(closure) + ". " + formatTransform(closure)});
  if (closure.probability)
    page.tiles.push_back(
        {urban_nav_core::formatNumber(*closure.probability, 4), "", "probability of the same place", Grade::Plain});
  const Evidence& evidence = closure.evidence;
  for (std::size_t i = 0; i < evidence.tries.size(); ++i) {
    const Evidence::Try& each = evidence.tries[i];
    Section section{"try" + std::to_string(i + 1),
                    tryTitle(evidence, i),
                    toString(each.verdict) + (each.sentence.empty() ? "" : ": " + each.sentence),
                    {},
                    {},
                    {makeTable("Tests", each.tests)}};
    if (auto picture = toPicture(each, place_data, cloud_half_length)) {
      picture->caption = each.method == ClosureMethod::Stereo ? kHowToReadViews : kHowToReadClouds;
      section.pictures.push_back(std::move(*picture));
    }
    page.sections.push_back(std::move(section));
  }
  if (!evidence.gate.empty())
    page.sections.push_back({"gate", loop_metric::kGateTitle, "", {}, {}, {makeTable("Tests", evidence.gate)}});
  if (evidence.tries.empty() && evidence.gate.empty())
    page.sections.push_back({"none", "Evidence", sentenceWithoutEvidence(closure), {}, {}, {}});
  page.footer = "urban_nav why, from the evidence in " + store.path() + ".";
  return page;
}

Json explainAsJson(const StoredClosure& closure) {
  Json json = Json::object();
  json["id"] = closure.id;
  json["session_a"] = closure.name_a;
  json["stamp_a_ns"] = closure.edge.a.stamp;
  json["session_b"] = closure.name_b;
  json["stamp_b_ns"] = closure.edge.b.stamp;
  json["kind"] = toString(closure.edge.kind);
  json["verdict"] = toString(closure.edge.verdict);
  json["reason"] = closure.edge.reason;
  json["weight"] = closure.edge.weight;
  const auto listTests = [](const std::vector<ClosureTest>& tests) {
    Json list = Json::array();
    for (const ClosureTest& test : tests) {
      Json one = Json::object();
      one["name"] = test.name;
      one["value"] = test.value;
      one["threshold"] = test.threshold;
      one["at_least"] = test.at_least;
      one["passed"] = test.passed;
      list.append(one);
    }
    return list;
  };
  Json& tries = json["tries"] = Json::array();
  for (const Evidence::Try& each : closure.evidence.tries) {
    Json one = Json::object();
    one["method"] = toString(each.method);
    one["verdict"] = toString(each.verdict);
    one["reason"] = each.reason;
    one["sentence"] = each.sentence;
    one["tests"] = listTests(each.tests);
    tries.append(one);
  }
  json["gate"] = listTests(closure.evidence.gate);
  return json;
}

std::string makeList(const std::vector<StoredClosure>& closures) {
  std::string text;
  for (const StoredClosure& closure : closures)
    text += std::to_string(closure.id) + "  " + closure.name_a + " +" +
            urban_nav_core::formatNumber(closure.since_a, 6) + "  " + closure.name_b + " +" +
            urban_nav_core::formatNumber(closure.since_b, 6) + "  " + formatVerdict(closure) + "\n";
  return text.empty() ? "no closures\n" : text;
}

}  // namespace urban_nav
