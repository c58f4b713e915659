// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// A stamp that precedes the newest one by more than this starts a new session: the recording is played again, or the
/// clock of the robot was set back. Smaller steps back are inputs that overtook each other. ns.
constexpr StampNs back_in_time = 1'000'000'000;

/// Returns whether `stamp` starts a new session after `newest`.
constexpr bool jumpsBack(StampNs stamp, StampNs newest) { return stamp < newest - back_in_time; }

}  // namespace urban_nav_core
