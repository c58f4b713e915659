// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

namespace urban_nav {

/// Time and memory used by the process since construction; for summaries, not for results.
class Usage {
 public:
  Usage();
  double wallSeconds() const;
  double cpuSeconds() const;           ///< of all threads, of the whole process
  static std::int64_t peakRssBytes();  ///< of the whole process

 private:
  std::chrono::steady_clock::time_point begin_;
  double cpu_begin_;
};

}  // namespace urban_nav
