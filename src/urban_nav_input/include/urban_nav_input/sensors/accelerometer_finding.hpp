// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/inertial/accelerometer_check.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Returns the defects of the accelerometer on a topic. `present`: convention by which its messages were read. The
/// options set the convention that corrects them.
std::vector<Finding> accelerometerFindings(const std::string& topic,
                                           const urban_nav_core::AccelerometerVerdict& verdict,
                                           const urban_nav_core::AccelerometerConvention& present);

}  // namespace urban_nav_input
