// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <thread>
#include <utility>

namespace urban_nav_core {

/// Names the calling thread for `top -H`, `ps -L` and debuggers. Linux keeps the first 15 bytes.
void nameThread(const std::string& name);

/// Starts a thread with a name.
template <typename Work>
std::thread namedThread(std::string name, Work work) {
  return std::thread([name = std::move(name), work = std::move(work)]() mutable {
    nameThread(name);
    work();
  });
}

}  // namespace urban_nav_core
