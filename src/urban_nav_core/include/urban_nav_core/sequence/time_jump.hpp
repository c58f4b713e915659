// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Largest backward step of stamps, ns, that is treated as a late message. A larger one starts a new session: the
/// recording was restarted or the clock was set.
constexpr StampNs kMaxStepBack = 1'000'000'000;

/// Returns whether `stamp` is more than kMaxStepBack before `newest`.
constexpr bool jumpsBack(StampNs stamp, StampNs newest) { return stamp < newest - kMaxStepBack; }

}  // namespace urban_nav_core
