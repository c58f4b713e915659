// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/stored_closure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "urban_nav_core/io/closures_csv.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/edit_journal.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;

namespace {

struct Beginning {
  std::string name;
  StampNs first = 0;
};

std::map<std::string, Beginning> readBeginnings(urban_nav_store::Store& store) {
  std::map<std::string, Beginning> result;
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    Beginning& its = result[session.id];
    its.name = session.name.empty() ? session.id : session.name;
    bool any = false;
    store.graph().forEachNode(session.id, [&](const urban_nav_store::Node& node) {
      if (!any) its.first = node.stamp;
      any = true;
    });
  }
  return result;
}

/// Returns the probability in the row of the candidate, if the evidence begins with one.
std::optional<double> probabilityIn(const std::string& evidence) {
  const std::string_view row =
      std::string_view(evidence).substr(0, evidence.size() - loop_metric::evidenceIn(evidence).size());
  try {
    const std::vector<urban_nav_core::ClosureRow> rows = urban_nav_core::parseClosures(row, "evidence");
    if (rows.size() == 1) return rows.front().probability;
  } catch (const UserError&) {
    // in the words of another stage
  }
  return std::nullopt;
}

StoredClosure describe(const Edge& edge, const std::map<std::string, Beginning>& beginnings,
                       const std::optional<std::string>& evidence) {
  StoredClosure closure;
  closure.edge = edge;
  const Beginning &a = beginnings.at(edge.a.session), &b = beginnings.at(edge.b.session);
  closure.name_a = a.name;
  closure.name_b = b.name;
  closure.since_a = urban_nav_core::secondsBetween(a.first, edge.a.stamp);
  closure.since_b = urban_nav_core::secondsBetween(b.first, edge.b.stamp);
  if (!evidence) return closure;
  closure.probability = probabilityIn(*evidence);
  const std::string_view its = loop_metric::evidenceIn(*evidence);
  if (!its.empty()) closure.evidence = loop_metric::parseEvidence(its);
  return closure;
}

double computeDistance(const std::string& name, const std::string& id, StampNs stamp, double since,
                       const TimeQuery& moment) {
  if (!moment.session.empty() && name.rfind(moment.session, 0) != 0 && id.rfind(moment.session, 0) != 0)
    return std::numeric_limits<double>::infinity();
  return moment.since_begin ? std::abs(since - moment.seconds)
                            : std::abs(urban_nav_core::secondsBetween(moment.stamp, stamp));
}

}  // namespace

std::vector<StoredClosure> listClosures(urban_nav_store::Store& store) {
  std::vector<Edge> edges;
  const std::map<std::string, Beginning> beginnings = readBeginnings(store);
  for (const auto& [id, beginning] : beginnings)
    store.graph().forEachEdge(id, [&](const Edge& edge) {
      if (edge.kind != EdgeKind::Odometry && beginnings.count(edge.b.session) > 0) edges.push_back(edge);
    });
  const std::map<urban_nav_store::EdgeKey, std::int64_t> numbers = urban_nav_store::readEdgeNumbers(store);
  std::sort(edges.begin(), edges.end(),
            [&](const Edge& x, const Edge& y) { return numbers.at(edgeKey(x)) < numbers.at(edgeKey(y)); });
  std::vector<StoredClosure> closures;
  for (const Edge& edge : edges) {
    StoredClosure closure = describe(edge, beginnings, store.graph().evidence(edge));
    closure.id = numbers.at(edgeKey(edge));
    closures.push_back(std::move(closure));
  }
  return closures;
}

StoredClosure describeEdge(urban_nav_store::Store& store, const Edge& edge, const std::string& evidence) {
  return describe(edge, readBeginnings(store), evidence);
}

double computeDistance(const StoredClosure& closure, const TimeQuery& one, const TimeQuery& other) {
  const auto at = [&](bool a, const TimeQuery& moment) {
    const Edge& edge = closure.edge;
    return a ? computeDistance(closure.name_a, edge.a.session, edge.a.stamp, closure.since_a, moment)
             : computeDistance(closure.name_b, edge.b.session, edge.b.stamp, closure.since_b, moment);
  };
  return std::min(std::max(at(true, one), at(false, other)), std::max(at(true, other), at(false, one)));
}

}  // namespace urban_nav
