// SPDX-License-Identifier: BSD-3-Clause
#include "view/page_serving.hpp"

#include <arpa/inet.h>

#include <ctime>

#include "urban_nav_core/types/error.hpp"
#include "view/browser.hpp"
#include "view/gate.hpp"

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

}  // namespace

EndSignals::EndSignals() {
  sigemptyset(&both_);
  sigaddset(&both_, SIGINT);
  sigaddset(&both_, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &both_, &before_);
}

EndSignals::~EndSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

bool EndSignals::wait(long nanoseconds) const {
  const timespec patience{0, nanoseconds};
  return ::sigtimedwait(&both_, nullptr, &patience) > 0;
}

PageServing::PageServing(const Arguments& arguments)
    : address_(listenAddress(arguments)),
      port_(static_cast<int>(arguments.integer("port", 0, 0, 65535))),
      opens_browser_(!arguments.has("no-browser")) {}

void PageServing::open() {
  if (!server_) server_ = std::make_unique<HttpServer>(address_, port_);
}

void PageServing::run(const HttpServer::Handler& answer, const std::function<void()>& poll, const std::string& what,
                      Console& console) {
  open();
  const std::unique_ptr<HttpServer> server = std::move(server_);  // ends before what answers its requests
  const Gate gate(address_, server->port());
  server->start([&](const HttpRequest& request) { return gate.admit(request); }, answer);
  console.print(gate.pageAddress() + "\n");
  console.info("Serving " + what + " at this address; press Ctrl-C to stop");
  const OpenedBrowser browser(opens_browser_ ? gate.pageAddress() : "");
  while (!signals_.wait(kPollInterval) && server->isRunning()) poll();
}

std::vector<Option> pageServingOptions(const std::string& read_only) {
  return {{"--port", "N", "port to listen on (default 0: a free one)", false, false, {}},
          {"--address",
           "A",
           "address of this machine to listen on (default 127.0.0.1: from this machine only)",
           false,
           false,
           {}},
          {"--read-only", "", read_only, false, false, {}},
          {"--no-browser", "", "prints the address and opens no browser", false, false, {}}};
}

}  // namespace urban_nav
