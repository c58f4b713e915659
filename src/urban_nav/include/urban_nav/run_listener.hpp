// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace urban_nav {

/// Receives the output of a command, for programs that call the suite as a library.
class RunListener {
 public:
  enum class Kind { Result, Info, Warning, Error };

  RunListener() = default;
  RunListener(const RunListener&) = delete;
  RunListener& operator=(const RunListener&) = delete;
  virtual ~RunListener() = default;

  /// Called from any thread of the run. An exception in the calling thread of runCommand() ends the run.
  virtual void takeLine(Kind kind, const std::string& line) = 0;
  /// Called in the calling thread of runCommand() at each progress: `done` of `total` units; `total` 0: unknown. An
  /// exception ends the run, which can be resumed as after an interruption.
  virtual void takeProgress(const std::string& label, std::int64_t done, std::int64_t total) = 0;
};

}  // namespace urban_nav
