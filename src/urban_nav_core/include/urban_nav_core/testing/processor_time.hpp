// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace urban_nav_core::testing {

/// Time that a clock of the processor has counted, ms. What else runs on the machine does not count.
inline double clockMs(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Time that all threads of this program have had of the processors, ms.
inline double processMs() { return clockMs(CLOCK_PROCESS_CPUTIME_ID); }

/// Time that this thread has had of a processor, ms.
inline double threadMs() { return clockMs(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace urban_nav_core::testing
