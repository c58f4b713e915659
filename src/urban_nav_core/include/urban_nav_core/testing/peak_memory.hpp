// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace urban_nav_core::testing {

/// By how much (bytes) the memory of the process grows while `work` runs, at its peak; 0 where the system does not say.
double measureMemory(const std::function<void()>& work);

}  // namespace urban_nav_core::testing
