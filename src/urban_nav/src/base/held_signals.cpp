// SPDX-License-Identifier: BSD-3-Clause
#include "base/held_signals.hpp"

#include <array>
#include <stdexcept>

namespace urban_nav {

namespace {

constexpr std::array<int, 3> kAllSignals = {SIGINT, SIGTERM, SIGHUP};

bool isIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

HeldSignals::HeldSignals() {
  sigemptyset(&held_);
  for (const int signal : kAllSignals)
    if (!isIgnored(signal))
      sigaddset(&held_, signal);  // blocking an ignored signal would make it pending, which defeats nohup
  pthread_sigmask(SIG_BLOCK, &held_, &before_);
}

HeldSignals::~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

void HeldSignals::check() const {
  sigset_t waiting;
  sigpending(&waiting);
  for (const int signal : kAllSignals)
    if (sigismember(&held_, signal) == 1 && sigismember(&waiting, signal) == 1) throw std::runtime_error("interrupted");
}

}  // namespace urban_nav
