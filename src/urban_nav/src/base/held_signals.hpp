// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace urban_nav {

/// Keeps SIGINT, SIGTERM and SIGHUP (those that are not ignored) waiting while it lives, so that what has been begun
/// can be tidied away; then they do what they always do. Holds for this thread and those that it starts from then on:
/// to be made before there are others.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// Throws std::runtime_error if one is waiting.
  void check() const;

 private:
  sigset_t held_{}, before_{};
};

}  // namespace urban_nav
