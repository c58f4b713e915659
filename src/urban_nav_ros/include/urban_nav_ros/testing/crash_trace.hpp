// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>

namespace urban_nav_ros::testing {

/// Writes the call stack of a test that crashes to its output, before the signal ends the process as usual: rostest
/// reports only that there are no results.
inline void writeCrashTrace(int signal) {
  std::array<void*, 64> frames{};
  const int size = ::backtrace(frames.data(), static_cast<int>(frames.size()));
  ::backtrace_symbols_fd(frames.data(), size, STDOUT_FILENO);
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

inline const bool kTracesCrashes = [] {
  void* frame = nullptr;
  ::backtrace(&frame, 1);  // loads the unwinder, which a handler must not
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, &writeCrashTrace);
  return true;
}();

}  // namespace urban_nav_ros::testing
