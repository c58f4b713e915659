// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>

namespace urban_nav {

/// The state followed by open pages: the number of changes of the map, and the running command. Thread-safe.
class PageEvents {
 public:
  struct State {
    std::int64_t number = 0;    ///< counts the changes of the following members
    std::int64_t revision = 1;  ///< counts the changes of the map
    std::string running;        ///< running command; empty: none
    std::string outcome;        ///< result of the last command, for the user
  };

  State state() const;
  void begin(const std::string& command);
  /// Reports the end of the command, which may have changed the map.
  void finish(const std::string& outcome, bool changed);
  /// Reports a change of the map by another program.
  void changed();
  /// Waits until the state has another number than `known`, about a second at most, and returns it.
  State wait(std::int64_t known) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  State state_;
};

/// Returns a state as one line of JSON.
std::string asData(const PageEvents::State& state);

}  // namespace urban_nav
