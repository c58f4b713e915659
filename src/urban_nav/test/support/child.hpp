// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace urban_nav::testing {

/// Runs the command in a separate process that can be killed.
class Child {
 public:
  Child(const std::vector<std::string>& words, const std::string& log) {
    const std::string program = (std::filesystem::canonical("/proc/self/exe").parent_path() / "urban_nav").string();
    std::vector<const char*> argv = {program.c_str()};
    for (const std::string& word : words) argv.push_back(word.c_str());
    argv.push_back(nullptr);
    child_ = ::fork();
    if (child_ == 0) {
      const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      ::dup2(output, 1);
      ::dup2(output, 2);
      ::execv(program.c_str(), const_cast<char* const*>(argv.data()));
      ::_exit(127);
    }
  }
  /// Kills it when it has used so much of a processor's time, which is less moved by what else is at work than a clock
  /// on the wall. The exit status, or empty where it was killed.
  std::optional<int> endWithin(double seconds) {
    clockid_t clock{};
    const bool known = ::clock_getcpuclockid(child_, &clock) == 0;
    return endOr([&] {
      timespec now{};
      return known && ::clock_gettime(clock, &now) == 0 &&
             toSeconds(now.tv_sec, 1e-9 * static_cast<double>(now.tv_nsec)) > seconds;
    });
  }
  /// Kills the process as soon as `now` returns true.
  std::optional<int> endOr(const std::function<bool()>& now) {
    for (bool killed = false;;) {
      int status = 0;
      rusage used{};
      if (::wait4(child_, &status, WNOHANG, &used) == child_) {
        seconds_ = toSeconds(used.ru_utime.tv_sec, 1e-6 * static_cast<double>(used.ru_utime.tv_usec)) +
                   toSeconds(used.ru_stime.tv_sec, 1e-6 * static_cast<double>(used.ru_stime.tv_usec));
        return WIFEXITED(status) ? std::optional<int>(WEXITSTATUS(status)) : std::nullopt;
      }
      if (!killed && now()) {
        ::kill(child_, SIGKILL);
        killed = true;
      }
      ::usleep(500);
    }
  }
  /// Sends a signal while it runs.
  void send(int signal) const { ::kill(child_, signal); }
  double secondsUsed() const { return seconds_; }

 private:
  static double toSeconds(time_t whole, double part) { return static_cast<double>(whole) + part; }

  pid_t child_;
  double seconds_ = 0.0;
};

}  // namespace urban_nav::testing
