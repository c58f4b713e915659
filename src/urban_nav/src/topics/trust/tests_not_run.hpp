// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"
#include "urban_nav_trust/consistency_test.hpp"

namespace urban_nav {

/// Returns the tests that no run makes (urban_nav_trust::kUnavailableTests), each with its reason in this run: the
/// sensor is missing, the measurement took part in the result, or there is no such test.
std::vector<urban_nav_trust::AbsentMeasurement> testsNotRun(const MapContext& context);

}  // namespace urban_nav
