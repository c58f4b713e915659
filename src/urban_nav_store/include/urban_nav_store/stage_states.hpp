// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// State from which a stage resumes after a session or a bag: bytes of any length in the encoding of the stage,
/// compressed and stored in parts of 1 MB.
class StageStates {
 public:
  virtual ~StageStates() = default;
  virtual void put(const SessionId& session, const std::string& stage, std::string_view bytes) = 0;
  virtual std::optional<std::string> get(const SessionId& session, const std::string& stage) const = 0;
  virtual void remove(const SessionId& session, const std::string& stage) = 0;
  /// Returns the compressed size of all states of a session.
  virtual std::int64_t bytes(const SessionId& session) const = 0;
  /// Returns the names of stages that have a state in this session, sorted.
  virtual std::vector<std::string> stages(const SessionId& session) const = 0;
};

}  // namespace urban_nav_store
