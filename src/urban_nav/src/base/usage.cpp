// SPDX-License-Identifier: BSD-3-Clause
#include "base/usage.hpp"

#include <sys/resource.h>

namespace urban_nav {

namespace {
double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double cpuNow() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}
}  // namespace

Usage::Usage() : begin_(std::chrono::steady_clock::now()), cpu_begin_(cpuNow()) {}

double Usage::wallSeconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}
double Usage::cpuSeconds() const { return cpuNow() - cpu_begin_; }

std::int64_t Usage::peakRssBytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<std::int64_t>(used.ru_maxrss) * 1024;  // Linux counts in kilobytes
}

}  // namespace urban_nav
