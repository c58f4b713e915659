// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// What a stage needs to go on behind a session or a bag: its state() as bytes of its own making, compressed here. Of any
/// length; kept in parts of 1 MB.
class StageStates {
 public:
  virtual ~StageStates() = default;
  virtual void put(const SessionId& session, const std::string& stage, std::string_view bytes) = 0;
  virtual std::optional<std::string> get(const SessionId& session, const std::string& stage) const = 0;
  virtual void remove(const SessionId& session, const std::string& stage) = 0;
  /// Room that the states of a session take, compressed.
  virtual std::int64_t bytes(const SessionId& session) const = 0;
  /// Names of stages that have a state here, sorted.
  virtual std::vector<std::string> stages(const SessionId& session) const = 0;
};

}  // namespace urban_nav_store
