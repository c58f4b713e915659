// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace urban_nav_core {

/// Corner at an integer pixel of one pyramid level.
struct Corner {
  std::int16_t u = 0, v = 0;  ///< px of its level
  std::uint8_t fast = 0;      ///< score of FAST (fast.hpp), grey levels
};

inline bool operator==(const Corner& a, const Corner& b) { return a.u == b.u && a.v == b.v && a.fast == b.fast; }

}  // namespace urban_nav_core
