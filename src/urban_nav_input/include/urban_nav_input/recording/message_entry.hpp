// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <tuple>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Place of a message of a connection.
struct MessageEntry {
  urban_nav_core::StampNs receipt = 0;  ///< time at which the recorder received it, ns
  std::uint64_t place = 0;              ///< in its file, ascending; its meaning is internal to the storage
};

inline bool operator<(const MessageEntry& a, const MessageEntry& b) {
  return std::tie(a.receipt, a.place) < std::tie(b.receipt, b.place);
}

}  // namespace urban_nav_input
