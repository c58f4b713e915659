// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/types/gps_reading.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Returns the stored fixes of a session, in order of time.
std::vector<urban_nav_core::PositionFix> readFixes(Store& store, const SessionId& session);

/// Writes fixes of a session, replacing those with equal stamps.
void writeFixes(Store& store, const SessionId& session, const std::vector<urban_nav_core::PositionFix>& fixes);

}  // namespace urban_nav_store
