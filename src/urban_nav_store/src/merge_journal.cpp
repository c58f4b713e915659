// SPDX-License-Identifier: BSD-3-Clause
#include "merge_journal.hpp"

#include <algorithm>
#include <tuple>

#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/edge_number.hpp"

namespace urban_nav_store {

namespace {

auto editContent(const StoredEdit& edit) {
  return std::make_tuple(edit.number, edit.session, edit.action, edit.arguments, edgeKey(edit.edge), edit.undone,
                         edit.dropped);
}

}  // namespace

void JournalMerge::add(Store& source) {
  for (StoredEdit& edit : EditJournal(source).all()) {
    const bool known = std::any_of(edits_.begin(), edits_.end(),
                                   [&](const StoredEdit& other) { return editContent(other) == editContent(edit); });
    if (!known) edits_.push_back(std::move(edit));
  }
  const TableStore<EdgeNumber> rows(source);
  for (const Session& session : source.sessions().all())
    rows.forEach(session.id, [&](const EdgeNumber& row) { numbers_[edgeKey(row.edge)].insert(row.number); });
}

std::vector<StoredEdit> JournalMerge::mergedEdits() const {
  std::vector<StoredEdit> edits = edits_;
  std::sort(edits.begin(), edits.end(),
            [](const StoredEdit& a, const StoredEdit& b) { return editContent(a) < editContent(b); });
  const auto clash = std::adjacent_find(edits.begin(), edits.end(),
                                        [](const StoredEdit& a, const StoredEdit& b) { return a.number == b.number; });
  if (clash == edits.end()) return edits;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    edits[i].number = static_cast<std::int64_t>(i) + 1;
    edits[i].dropped = edits[i].undone;
  }
  return edits;
}

std::map<EdgeKey, std::int64_t> JournalMerge::mergedNumbers() const {
  std::map<EdgeKey, std::int64_t> merged;
  std::set<std::int64_t> used;
  bool clash = false;
  std::vector<std::pair<std::int64_t, EdgeKey>> order;
  for (const auto& [key, numbers] : numbers_) {
    merged[key] = *numbers.begin();
    clash = clash || numbers.size() > 1 || !used.insert(*numbers.begin()).second;
    order.emplace_back(*numbers.begin(), key);
  }
  if (!clash) return merged;
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) merged[order[i].second] = static_cast<std::int64_t>(i) + 1;
  return merged;
}

void JournalMerge::write(Store& target, bool with_numbers) const {
  TableStore<StoredEdit> edits(target);
  for (const StoredEdit& edit : mergedEdits()) edits.put(edit);
  if (!with_numbers) return;
  TableStore<EdgeNumber> rows(target);
  for (const auto& [key, number] : mergedNumbers()) {
    EdgeNumber row;
    std::tie(row.edge.a.session, row.edge.a.stamp, row.edge.b.session, row.edge.b.stamp, row.edge.kind,
             row.edge.source) = key;
    row.number = number;
    rows.put(row);
  }
}

}  // namespace urban_nav_store
