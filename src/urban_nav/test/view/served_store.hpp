// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "commands/stages.hpp"
#include "view/gate.hpp"
#include "view/http_client.hpp"
#include "view/http_server.hpp"
#include "view/page_routes.hpp"
#include "view/stored_source.hpp"

namespace urban_nav::testing {

/// A server as `view` starts it.
class ServedStore {
 public:
  explicit ServedStore(const std::string& path, bool read_only = false, const std::string& compared = "")
      : source_(path, compared, read_only, {}, addStageTables, events_) {
    server_.start([this](const HttpRequest& request) { return gate_.admit(request); },
                  [this](const HttpRequest& request) { return routes_.answer(request); });
  }
  ~ServedStore() { server_.stop(); }

  int port() const { return server_.port(); }
  std::string token() const { return gate_.token(); }
  std::string address() const { return gate_.pageAddress(); }
  StoredSource& source() { return source_; }
  RawAnswer get(const std::string& path) const {
    return sendRequest(port(), "GET", path, "X-Urban-Nav-Token: " + token() + "\r\n");
  }
  RawAnswer edit(const std::string& body) const {
    return sendRequest(port(), "POST", "/api/edit",
                       "Content-Type: application/json\r\nX-Urban-Nav-Token: " + token() + "\r\n", body);
  }

 private:
  PageEvents events_;
  StoredSource source_;
  PageRoutes routes_{source_, events_};
  HttpServer server_{"127.0.0.1", 0};
  Gate gate_{"127.0.0.1", server_.port()};
};

}  // namespace urban_nav::testing
