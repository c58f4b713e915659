// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "loop_metric/evidence.hpp"
#include "map/closure_rows.hpp"
#include "map/previous_sessions.hpp"
#include "urban_nav/stored_results.hpp"
#include "urban_nav_core/io/closures_csv.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav {

using urban_nav_core::ClosureRow;
using urban_nav_store::Edge;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

/// A row of closures.csv and its position.
struct PlacedRow {
  ClosurePlace place;
  std::vector<std::string> cells;
};

/// Returns the row of closures.csv stored with an edge, with exact cells; nullopt for edges of other stages. `a`, `b`:
/// names of its sessions.
std::optional<PlacedRow> storedRow(const std::string& evidence, const std::string& a, const std::string& b,
                                   const std::vector<std::string>& names) {
  const std::string_view text = evidence;
  const std::string_view row = text.substr(0, text.size() - loop_metric::evidenceIn(text).size());
  try {
    const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::parse(row, "evidence");
    const std::vector<ClosureRow> parsed = urban_nav_core::parseClosures(row, "evidence");
    if (parsed.size() != 1) return std::nullopt;
    PlacedRow placed;
    for (std::size_t column = 0; column < table.header().size(); ++column)
      placed.cells.push_back(table.text(0, column));
    placed.cells.at(table.column("session_a")) = a;
    placed.cells.at(table.column("session_b")) = b;
    placed.place = closurePlace(names, {a, parsed.front().a.stamp}, {b, parsed.front().b.stamp}, parsed.front().method);
    return placed;
  } catch (const urban_nav_core::UserError&) {
    return std::nullopt;  // the evidence of another stage
  }
}

}  // namespace

namespace {

/// Clears the measured cells of a row.
void clearMeasurement(std::vector<std::string>& cells) {
  constexpr std::size_t kCandidate = 5;  // session_a, stamp_a_ns, session_b, stamp_b_ns, probability
  for (std::size_t i = kCandidate; i < cells.size(); ++i) cells[i].clear();
}

std::string printStoredClosures(Store& store, const PreviousSessions& sessions, bool as_candidates) {
  std::map<SessionId, std::string> names;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) names[sessions.ids[s]] = sessions.names[s];
  std::vector<PlacedRow> rows;
  for (const SessionId& id : sessions.ids) {
    std::vector<Edge> edges;
    store.graph().forEachEdge(id, [&](const Edge& edge) {
      if (edge.kind != urban_nav_store::EdgeKind::Odometry && names.count(edge.b.session) != 0) edges.push_back(edge);
    });
    for (const Edge& edge : edges) {
      const std::optional<std::string> evidence = store.graph().evidence(edge);
      if (!evidence) continue;
      auto row = storedRow(*evidence, names.at(edge.a.session), names.at(edge.b.session), sessions.names);
      if (!row || (as_candidates && urban_nav_store::isOfEdit(edge.source))) continue;
      if (as_candidates && urban_nav_store::isFoundAnew(edge.kind, edge.source)) clearMeasurement(row->cells);
      rows.push_back(std::move(*row));
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const PlacedRow& a, const PlacedRow& b) { return a.place < b.place; });
  std::string text = urban_nav_core::printClosures({});
  for (const PlacedRow& row : rows) text += urban_nav_core::printCsvRow(row.cells);
  return text;
}

}  // namespace

std::string readStoredClosures(Store& store) {
  return printStoredClosures(store, readPreviousSessions(store, {}), false);
}

std::string readStoredCandidates(Store& store, const std::vector<SessionId>& ids) {
  std::vector<SessionId> others;
  for (const urban_nav_store::Session& session : store.sessions().all())
    if (std::find(ids.begin(), ids.end(), session.id) == ids.end()) others.push_back(session.id);
  return printStoredClosures(store, readPreviousSessions(store, others), true);
}

}  // namespace urban_nav
