// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "urban_nav_store/store.hpp"
#include "urban_nav_store/tables/stored_edit.hpp"

namespace urban_nav_store {

/// Edits of a store in the order of their numbers, including undone ones. The store must outlive this object. Changes
/// are not committed. Not thread-safe. Throws the errors of Store.
class EditJournal {
 public:
  explicit EditJournal(Store& store) : store_(&store) {}

  std::vector<StoredEdit> all() const;
  /// Returns the edits that are not undone.
  std::vector<StoredEdit> standing() const;
  /// Appends an edit and returns its number. Undone edits can no longer be redone.
  std::int64_t append(StoredEdit edit);
  /// Undoes the newest `count` edits in force, or all if there are fewer. Returns their numbers, the newest first.
  std::vector<std::int64_t> undo(std::size_t count);
  /// Redoes the edit undone last. Returns its number; nullopt if there is nothing to redo.
  std::optional<std::int64_t> redo();
  /// Removes an edit.
  void remove(std::int64_t number);

 private:
  void put(const StoredEdit& edit);

  Store* store_;
};

/// Prefix of the source of edges added by edits.
constexpr const char* kEditSource = "edit";
/// Returns whether an edge was added by an edit, and is therefore not a measurement.
bool isOfEdit(const std::string& source);

/// Identity of an edge.
using EdgeKey = std::tuple<SessionId, std::int64_t, SessionId, std::int64_t, EdgeKind, std::string>;
EdgeKey edgeKey(const Edge& edge);

/// Returns the numbers of the edges of a store that close loops. Edges without a stored number follow all others, in
/// the order of the later of their poses. The numbers are reproducible until the store is written; see
/// storeEdgeNumbers().
std::map<EdgeKey, std::int64_t> readEdgeNumbers(Store& store);
/// Stores the numbers of all edges, which makes them permanent. Does not commit.
void storeEdgeNumbers(Store& store);

}  // namespace urban_nav_store
