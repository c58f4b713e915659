// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Division of a session into passes: parts of the path that visit no place twice.
struct SessionPasses {
  struct Begin {
    urban_nav_core::StampNs stamp = 0;
    std::uint16_t pass = 0;
  };
  std::vector<Begin> begins;  ///< in order of time

  /// Returns the pass at a stamp; the first one before the session.
  std::uint16_t at(urban_nav_core::StampNs stamp) const;
};

/// Returns the passes of sessions in one map, numbered consecutively over the sessions, up to 65535. A pass ends where
/// the path comes within 10 m of a place that it left more than 40 m of path earlier.
std::vector<SessionPasses> findPasses(const std::vector<const urban_nav_core::Trajectory*>& T_map_base);

}  // namespace laser_mapper
