// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "schema/table_access.hpp"
#include "urban_nav_store/stage_states.hpp"

namespace urban_nav_store {

class SqliteStageStates : public StageStates {
 public:
  explicit SqliteStageStates(TableAccess& tables) : tables_(tables) {}

  void put(const SessionId& session, const std::string& stage, std::string_view bytes) override;
  std::optional<std::string> get(const SessionId& session, const std::string& stage) const override;
  void remove(const SessionId& session, const std::string& stage) override;
  std::int64_t bytes(const SessionId& session) const override;
  std::vector<std::string> stages(const SessionId& session) const override;

 private:
  TableAccess& tables_;
};

}  // namespace urban_nav_store
