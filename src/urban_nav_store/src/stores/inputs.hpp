// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "schema/table_access.hpp"
#include "urban_nav_store/input_order.hpp"

namespace urban_nav_store {

/// Events in blocks of a fixed number; the last block of a session is kept in memory and replaces that of the file
/// before a commit.
class SqliteInputOrder : public InputOrder {
 public:
  explicit SqliteInputOrder(TableAccess& tables) : tables_(tables) {}

  void append(const SessionId& session, const InputEvent& event) override;
  void forEach(const SessionId& session, const std::function<void(const InputEvent&)>& take) const override;

  void flush() const;
  void forget() { open_.clear(); }

 private:
  struct Block {
    std::int64_t number = 0;
    std::vector<InputEvent> events;
    bool changed = false;
  };
  Block last(const SessionId& session) const;
  void save(const SessionId& session, Block& block) const;

  TableAccess& tables_;
  mutable std::map<SessionId, Block> open_;
};

}  // namespace urban_nav_store
