// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/edit_journal.hpp"

#include <algorithm>

#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/edge_number.hpp"

namespace urban_nav_store {

std::vector<StoredEdit> EditJournal::all() const {
  std::vector<StoredEdit> edits;
  const TableStore<StoredEdit> rows(*store_);
  for (const Session& session : store_->sessions().all())
    rows.forEach(session.id, [&](const StoredEdit& edit) { edits.push_back(edit); });
  std::stable_sort(edits.begin(), edits.end(),
                   [](const StoredEdit& a, const StoredEdit& b) { return a.number < b.number; });
  return edits;
}

std::vector<StoredEdit> EditJournal::standing() const {
  std::vector<StoredEdit> edits = all();
  edits.erase(std::remove_if(edits.begin(), edits.end(), [](const StoredEdit& edit) { return edit.undone; }),
              edits.end());
  return edits;
}

void EditJournal::put(const StoredEdit& edit) { TableStore<StoredEdit>(*store_).put(edit); }

std::int64_t EditJournal::append(StoredEdit edit) {
  edit.number = 1;
  for (StoredEdit& earlier : all()) {
    edit.number = std::max(edit.number, earlier.number + 1);
    if (!earlier.undone || earlier.dropped) continue;
    earlier.dropped = true;
    put(earlier);
  }
  put(edit);
  return edit.number;
}

std::vector<std::int64_t> EditJournal::undo(std::size_t count) {
  std::vector<StoredEdit> edits = standing();
  std::vector<std::int64_t> undone;
  while (undone.size() < count && !edits.empty()) {
    edits.back().undone = true;
    put(edits.back());
    undone.push_back(edits.back().number);
    edits.pop_back();
  }
  return undone;
}

std::optional<std::int64_t> EditJournal::redo() {
  for (StoredEdit& edit : all()) {
    if (!edit.undone || edit.dropped) continue;
    edit.undone = false;
    put(edit);
    return edit.number;
  }
  return std::nullopt;
}

void EditJournal::remove(std::int64_t number) {
  for (const StoredEdit& edit : all())
    if (edit.number == number) TableStore<StoredEdit>(*store_).remove(edit);
}

bool isOfEdit(const std::string& source) { return source.rfind(kEditSource, 0) == 0; }

EdgeKey edgeKey(const Edge& edge) {
  return {edge.a.session, edge.a.stamp, edge.b.session, edge.b.stamp, edge.kind, edge.source};
}

std::map<EdgeKey, std::int64_t> readEdgeNumbers(Store& store) {
  std::map<EdgeKey, std::int64_t> numbers;
  std::int64_t last = 0;
  std::vector<Edge> edges;
  const TableStore<EdgeNumber> rows(store);
  const std::vector<Session> sessions = store.sessions().all();
  const auto known = [&](const SessionId& id) {
    return std::any_of(sessions.begin(), sessions.end(), [&](const Session& session) { return session.id == id; });
  };
  for (const Session& session : sessions) {
    rows.forEach(session.id, [&](const EdgeNumber& row) {
      numbers[edgeKey(row.edge)] = row.number;
      last = std::max(last, row.number);
    });
    store.graph().forEachEdge(session.id, [&](const Edge& edge) {
      if (edge.kind != EdgeKind::Odometry && known(edge.b.session)) edges.push_back(edge);
    });
  }
  const auto place = [](const Edge& edge) {
    return std::make_tuple(std::max(edge.a.stamp, edge.b.stamp), std::min(edge.a.stamp, edge.b.stamp), edge.a.session,
                           edge.b.session, edge.kind, edge.source);
  };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return place(a) < place(b); });
  for (const Edge& edge : edges)
    if (numbers.emplace(edgeKey(edge), last + 1).second) ++last;
  return numbers;
}

void storeEdgeNumbers(Store& store) {
  TableStore<EdgeNumber> rows(store);
  for (const auto& [key, number] : readEdgeNumbers(store)) {
    EdgeNumber row;
    std::tie(row.edge.a.session, row.edge.a.stamp, row.edge.b.session, row.edge.b.stamp, row.edge.kind,
             row.edge.source) = key;
    row.number = number;
    if (!rows.get(row)) rows.put(row);
  }
}

}  // namespace urban_nav_store
