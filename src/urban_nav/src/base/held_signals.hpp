// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace urban_nav {

/// Blocks SIGINT, SIGTERM and SIGHUP (those that are not ignored) during its lifetime, so that temporary files can be
/// removed; pending signals are delivered afterwards. Applies to this thread and threads started by it later: construct
/// it before starting others.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// Throws std::runtime_error if a signal is pending.
  void check() const;

 private:
  sigset_t held_{}, before_{};
};

}  // namespace urban_nav
