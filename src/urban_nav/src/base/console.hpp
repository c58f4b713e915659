// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "urban_nav/run_listener.hpp"

namespace urban_nav {

/// Where the command speaks to its user: results on the standard output, everything else on the standard error, so that
/// one can be piped without the other. Lines of several threads do not mix. Control characters, which names in a file
/// may hold, are shown as printable() spells them.
class Console {
 public:
  Console();
  /// Gives everything to a listener, which outlives this object, and prints nothing.
  explicit Console(RunListener& listener);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// A result, of any number of lines.
  void print(const std::string& text);
  void info(const std::string& line);
  void warn(const std::string& line);
  void error(const std::string& line);

  /// Reports progress to a listener, if there is one.
  void progress(const std::string& label, std::int64_t done, std::int64_t total);
  /// Text that the next line, or the next such text, replaces; nothing where the output is no terminal.
  void transient(const std::string& text);
  bool isTerminal() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// How far a long work is: a bar with rate and time left on a terminal, a line every few seconds elsewhere.
class Progress {
 public:
  /// `total` in `unit`s; 0: unknown.
  Progress(Console& console, std::string label, std::string unit, std::int64_t total);
  /// Cheap: may be called for each frame.
  void update(std::int64_t done);
  /// The last word, with the mean rate.
  void finish(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string line(std::int64_t done, double seconds) const;

  Console& console_;
  std::string label_, unit_;
  std::int64_t total_;
  Clock::time_point begin_, last_;
};

/// "0:07", "12:34", "1:02:03".
std::string printDuration(double seconds);

}  // namespace urban_nav
