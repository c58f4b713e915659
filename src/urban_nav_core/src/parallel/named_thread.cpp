// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parallel/named_thread.hpp"

#include <pthread.h>

namespace urban_nav_core {

namespace {

constexpr std::size_t kNameBytes = 15;

}  // namespace

void nameThread(const std::string& name) { pthread_setname_np(pthread_self(), name.substr(0, kNameBytes).c_str()); }

}  // namespace urban_nav_core
