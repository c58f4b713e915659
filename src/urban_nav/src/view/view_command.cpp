// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>

#include <csignal>
#include <ctime>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "urban_nav_core/types/error.hpp"
#include "view/browser.hpp"
#include "view/gate.hpp"
#include "view/http_server.hpp"
#include "view/page_routes.hpp"
#include "view/stored_source.hpp"
#include "view/view.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr long kPollInterval = 500'000'000;  // ns

/// Returns the numeric address to listen on.
std::string listenAddress(const Arguments& arguments) {
  const std::string address = arguments.get("address", "127.0.0.1");
  in_addr four{};
  in6_addr six{};
  const bool is_four = ::inet_pton(AF_INET, address.c_str(), &four) == 1;
  if (!is_four && ::inet_pton(AF_INET6, address.c_str(), &six) != 1)
    throw UserError("--address", address, "one numeric address of this machine: 127.0.0.1, 192.168.1.7, ::1");
  if ((is_four && four.s_addr == INADDR_ANY) || (!is_four && IN6_IS_ADDR_UNSPECIFIED(&six) != 0))
    throw UserError("--address", address + " means all addresses of this machine",
                    "the address by which the page will be opened");
  return address;
}

/// Blocks SIGINT and SIGTERM in all threads started later, until one of them is received.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&both_);
    sigaddset(&both_, SIGINT);
    sigaddset(&both_, SIGTERM);
    ::pthread_sigmask(SIG_BLOCK, &both_, &before_);
  }
  ~EndSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  /// Waits for a signal; returns false after the timeout.
  bool wait(long nanoseconds) const {
    const timespec patience{0, nanoseconds};
    return ::sigtimedwait(&both_, nullptr, &patience) > 0;
  }

 private:
  sigset_t both_{}, before_{};
};

StoredSource::Values commonOptions(const Arguments& arguments) {
  StoredSource::Values values;
  for (const char* name : {"config", "set", "threads"})
    if (arguments.has(name)) values[name] = arguments.all(name);
  return values;
}

int runView(const Arguments& arguments, const ParameterTables& tables, Console& console) {
  checkCommonOptions(arguments);
  const std::string address = listenAddress(arguments);
  const int port = static_cast<int>(arguments.integer("port", 0, 0, 65535));
  const EndSignals signals;
  PageEvents events;
  StoredSource source(arguments.get("STORE"), arguments.get("STORE2", ""), arguments.has("read-only"),
                      commonOptions(arguments), tables, events);
  const PageRoutes routes(source, events);
  HttpServer server(address, port);
  const Gate gate(address, server.port());
  server.start([&](const HttpRequest& request) { return gate.admit(request); },
               [&](const HttpRequest& request) { return routes.answer(request); });
  console.print(gate.pageAddress() + "\n");
  console.info("Serving " + arguments.get("STORE") + " at this address; press Ctrl-C to stop");
  {
    const OpenedBrowser browser(arguments.has("no-browser") ? "" : gate.pageAddress());
    while (!signals.wait(kPollInterval) && server.isRunning()) source.poll();
  }
  server.stop();
  return 0;
}

}  // namespace

Command viewCommand(ParameterTables tables) {
  Command command;
  command.name = "view";
  command.summary = "Shows a map and its closures in the browser; corrections are edits as by `edge`.";
  command.options = {{"STORE", "", "session.db of a map", true, false, {}},
                     {"STORE2",
                      "",
                      "another store to compare: its poses of the sessions of STORE, and their distances",
                      false,
                      false,
                      {}},
                     {"--port", "N", "port to listen on (default 0: a free one)", false, false, {}},
                     {"--address",
                      "A",
                      "address of this machine to listen on (default 127.0.0.1: from this machine only)",
                      false,
                      false,
                      {}},
                     {"--read-only", "", "do not allow edits", false, false, {}},
                     {"--no-browser", "", "prints the address and opens no browser", false, false, {}},
                     configOption(),
                     setOption(),
                     threadsOption()};
  command.examples = {"urban_nav view out/session.db", "urban_nav view out/session.db before/session.db",
                      "urban_nav view out/session.db --read-only --port 8080"};
  command.more_help = commonHelp;
  command.run = [tables = std::move(tables)](const Arguments& arguments, Console& console) {
    return runView(arguments, tables, console);
  };
  return command;
}

}  // namespace urban_nav
