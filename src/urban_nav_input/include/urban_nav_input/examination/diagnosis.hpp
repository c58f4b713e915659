// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/sessions.hpp"

namespace urban_nav_input {

/// Contents and defects of a session.
struct Diagnosis {
  std::string name, kind;
  std::vector<std::string> contents;  ///< sentences: cameras, lasers, calibration, duration
  std::int64_t pairs = 0;             ///< stereo pairs, complete or not
  std::int64_t complete = 0;          ///< pairs with two readable images
  double duration_s = 0.0, rate_hz = 0.0;
  std::vector<InputStream> inputs;  ///< by role
  std::vector<Finding> findings;

  /// Returns whether stages can use the session.
  bool isUsable() const;
};

/// Returns the inputs that can be opened. Each other input (a truncated or empty bag) becomes a diagnosis. Throws
/// UserError for an input of unknown kind.
std::vector<std::string> separateUnreadable(const std::vector<std::string>& inputs, std::vector<Diagnosis>& unreadable);

/// Reads a session once, as the stages do, and examines it. `progress`: called for each pair with the expected number
/// of pairs, 0 if unknown. Does not throw for defects of the input: each is a finding.
Diagnosis examine(const InputSession& session, const SourceOptions& options,
                  const std::function<void(std::int64_t done, std::int64_t total)>& progress);

}  // namespace urban_nav_input
