// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace urban_nav_core::testing {

/// Returns the time of a processor clock, ms, which excludes other processes.
inline double clockMs(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Returns the processor time of all threads of this program, ms.
inline double processMs() { return clockMs(CLOCK_PROCESS_CPUTIME_ID); }

/// Returns the processor time of this thread, ms.
inline double threadMs() { return clockMs(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace urban_nav_core::testing
