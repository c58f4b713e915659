// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "sqlite/connection.hpp"
#include "urban_nav_store/input_order.hpp"

namespace urban_nav_store {

/// Events in blocks of a fixed number; the last block of a session stays in memory and replaces the one in the file when a
/// commit is near.
class Inputs : public InputOrder {
 public:
  explicit Inputs(Connection& connection) : connection_(connection) {}

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

  Connection& connection_;
  mutable std::map<SessionId, Block> open_;
};

}  // namespace urban_nav_store
