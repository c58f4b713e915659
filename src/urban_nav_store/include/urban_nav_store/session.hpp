// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_store {

/// 20 hexadecimal digits. Rows of all tables refer to each other by it and a stamp, never by a row's number, so that files
/// of several computers can be joined.
using SessionId = std::string;

/// What tells a session from every other: known before its first measurement is processed, and the same whenever, wherever
/// and however often the recording is mapped.
struct SessionOrigin {
  std::string robot;      ///< its name; may be empty
  std::string recording;  ///< live: the name of the recording; offline: may be empty, the inputs say it
  urban_nav_core::StampNs start = 0;  ///< live: of the session; offline: may be 0
  std::string inputs;                 ///< offline: a digest of the recording; live: empty
};

/// The first 80 bits of SHA-256 (FIPS 180-4) of the origin. Nothing random: the computers of one robot agree on the id of a
/// live session by its name and start, a recording mapped twice has one id, and two others share one by accident once in
/// 10^12 stores of a million sessions.
SessionId sessionIdOf(const SessionOrigin& origin);

struct Session {
  SessionId id;
  std::string name;  ///< for people
  std::string robot;
  std::string recording;
  urban_nav_core::StampNs start = 0;
  bool complete = false;  ///< all that was measured in it has been processed
};

bool operator==(const Session& a, const Session& b);

/// Which map a session is part of. A map has the name of the session at whose first pose it has its origin; a session
/// without an anchor is a map of its own, in which `map` and `odom` are one.
struct Anchor {
  SessionId session;
  SessionId map;
  std::int64_t revision = 0;  ///< of the graph; the higher one holds where files are joined
  urban_nav_core::Pose T_map_odom;
};

}  // namespace urban_nav_store
