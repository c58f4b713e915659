// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/peak_memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace urban_nav_core::testing {

namespace {

/// Returns a value of /proc/self/status, bytes.
double memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(key + ":", 0) == 0) return 1024.0 * std::stod(line.substr(key.size() + 1));
  return 0.0;
}

}  // namespace

double measureMemory(const std::function<void()>& work) {
  std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak (Linux, proc(5))
  const double before = memory("VmRSS");
  work();
  return std::max(0.0, memory("VmHWM") - before);
}

}  // namespace urban_nav_core::testing
