// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_core {

/// Returns a number as text for reports and messages: `digits` significant digits, trailing zeros omitted, no exponent
/// from 1e-5 to 1e11, an en dash for values that are not finite. Files are written by printNumber().
std::string formatNumber(double value, int digits = 3);

}  // namespace urban_nav_core
