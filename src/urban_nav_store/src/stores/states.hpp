// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sqlite/connection.hpp"
#include "urban_nav_store/stage_states.hpp"

namespace urban_nav_store {

class States : public StageStates {
 public:
  explicit States(Connection& connection) : connection_(connection) {}

  void put(const SessionId& session, const std::string& stage, std::string_view bytes) override;
  std::optional<std::string> get(const SessionId& session, const std::string& stage) const override;
  void remove(const SessionId& session, const std::string& stage) override;
  std::int64_t bytes(const SessionId& session) const override;
  std::vector<std::string> stages(const SessionId& session) const override;

 private:
  Connection& connection_;
};

}  // namespace urban_nav_store
