// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_store {

/// 20 hexadecimal digits. Rows of all tables refer to each other by session and stamp, never by row number, so that
/// files of several computers can be merged.
using SessionId = std::string;

/// Identity of a session: known before its first measurement is processed, and the same whenever and wherever the
/// recording is mapped.
struct SessionOrigin {
  std::string robot;                  ///< name; may be empty
  std::string recording;              ///< live: name of the recording; offline: may be empty, the inputs identify it
  urban_nav_core::StampNs start = 0;  ///< live: of the session; offline: may be 0
  std::string inputs;                 ///< offline: digest of the recording; live: empty
};

/// Returns the first 80 bits of SHA-256 (FIPS 180-4) of the origin. Deterministic: all computers of one robot compute
/// the same id of a live session from its name and start, and a recording mapped twice has one id. Probability that any
/// two of a million sessions collide: 10^-12.
SessionId makeSessionId(const SessionOrigin& origin);
/// A session: one uninterrupted drive of one robot.
struct Session {
  SessionId id;
  std::string name;  ///< for display
  std::string robot;
  std::string recording;
  urban_nav_core::StampNs start = 0;
  bool complete = false;  ///< all its measurements have been processed
};

bool operator==(const Session& a, const Session& b);

/// Relation of a session to a map. A map is named after the session whose first pose is its origin. A session without
/// an anchor is a separate map, in which `map` and `odom` coincide.
struct Anchor {
  SessionId session;
  SessionId map;
  std::int64_t revision = 0;  ///< of the graph; a merge keeps the highest
  urban_nav_core::Pose T_map_odom;
};

}  // namespace urban_nav_store
