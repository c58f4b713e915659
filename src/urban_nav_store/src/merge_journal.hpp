// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <vector>

#include "urban_nav_store/edit_journal.hpp"

namespace urban_nav_store {

/// Merges the edits and the numbers of edges of several stores. Numbers are kept unless two stores use one for
/// different items; then all are assigned anew, in an order that depends only on their content, and undone edits can no
/// longer be redone.
class JournalMerge {
 public:
  void add(Store& source);
  /// Writes the edits, and the numbers of edges if `with_numbers`. Does not commit.
  void write(Store& target, bool with_numbers) const;

 private:
  std::vector<StoredEdit> mergedEdits() const;
  std::map<EdgeKey, std::int64_t> mergedNumbers() const;

  std::vector<StoredEdit> edits_;
  std::map<EdgeKey, std::set<std::int64_t>> numbers_;
};

}  // namespace urban_nav_store
