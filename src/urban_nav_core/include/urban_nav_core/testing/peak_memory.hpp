// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace urban_nav_core::testing {

/// Returns the peak growth of the process's memory while `work` runs, bytes; 0 if the system does not provide it.
double measureMemory(const std::function<void()>& work);

}  // namespace urban_nav_core::testing
