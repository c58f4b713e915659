// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "urban_nav/run_listener.hpp"

namespace urban_nav {

/// Output of the command: results on the standard output, everything else on the standard error. Thread-safe: lines of
/// several threads are not mixed. Control characters, as in names in a file, are escaped by printable().
class Console {
 public:
  Console();
  /// Forwards all output to a listener, which must outlive this object, and prints nothing.
  explicit Console(RunListener& listener);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Prints a result of any number of lines.
  void print(const std::string& text);
  void info(const std::string& line);
  void warn(const std::string& line);
  void error(const std::string& line);

  /// Reports progress to a listener, if there is one.
  void progress(const std::string& label, std::int64_t done, std::int64_t total);
  /// Prints a text that the next output replaces; no effect if the output is not a terminal.
  void transient(const std::string& text);
  bool isTerminal() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Progress of a long task: a bar with rate and remaining time on a terminal, else a line every few seconds.
class Progress {
 public:
  /// `total` in `unit`s; 0: unknown.
  Progress(Console& console, std::string label, std::string unit, std::int64_t total);
  /// Cheap enough to be called for each frame.
  void update(std::int64_t done);
  /// Prints the final line with the mean rate.
  void finish(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string line(std::int64_t done, double seconds) const;

  Console& console_;
  std::string label_, unit_;
  std::int64_t total_;
  Clock::time_point begin_, last_;
};

/// Formats a duration: "0:07", "12:34", "1:02:03".
std::string printDuration(double seconds);

}  // namespace urban_nav
