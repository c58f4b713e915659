// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "base/console.hpp"
#include "view/http_server.hpp"

namespace urban_nav {

/// Blocks SIGINT and SIGTERM in all threads started later, until one of them is received.
class EndSignals {
 public:
  EndSignals();
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  /// Waits for a signal; returns false after the timeout, ns.
  bool wait(long nanoseconds) const;

 private:
  sigset_t both_{}, before_{};
};

/// Serves a page of a command until SIGINT or SIGTERM: prints its address, and opens the browser where there is a
/// display. Construct it before the threads of the command.
class PageServing {
 public:
  /// Reads --address, --port and --no-browser. Throws UserError for bad values.
  explicit PageServing(const Arguments& arguments);

  /// Opens the port. Throws UserError if it is in use.
  void open();
  /// Answers requests with the token. `poll` is called about twice a second; `what`: name of what is served. Blocks
  /// until the end.
  void run(const HttpServer::Handler& answer, const std::function<void()>& poll, const std::string& what,
           Console& console);

 private:
  std::string address_;
  int port_;
  bool opens_browser_;
  EndSignals signals_;
  std::unique_ptr<HttpServer> server_;
};

/// Options of a command that serves a page: --port, --address, --read-only with this sentence, --no-browser.
std::vector<Option> pageServingOptions(const std::string& read_only);

}  // namespace urban_nav
