// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "topics/labels/label_model_file.hpp"
#include "view/gate.hpp"
#include "view/http_client.hpp"
#include "view/http_server.hpp"
#include "view/teach/teach_routes.hpp"

namespace urban_nav::testing {

/// A server as `labels teach` starts it.
class ServedScene {
 public:
  ServedScene(const std::string& scene, const std::string& model, const std::string& corrections,
              bool read_only = false)
      : source_(setup(scene, model, corrections, read_only), events_) {
    server_.start([this](const HttpRequest& request) { return gate_.admit(request); },
                  [this](const HttpRequest& request) { return routes_.answer(request); });
  }
  ~ServedScene() { server_.stop(); }

  int port() const { return server_.port(); }
  std::string token() const { return gate_.token(); }
  std::string address() const { return gate_.pageAddress(); }
  TeachSource& source() { return source_; }
  RawAnswer get(const std::string& path) const {
    return sendRequest(port(), "GET", path, "X-Urban-Nav-Token: " + token() + "\r\n");
  }
  RawAnswer post(const std::string& body) const {
    return sendRequest(port(), "POST", "/api/correct",
                       "Content-Type: application/json\r\nX-Urban-Nav-Token: " + token() + "\r\n", body);
  }

 private:
  static TeachSource::Setup setup(const std::string& scene, const std::string& model, const std::string& corrections,
                                  bool read_only) {
    TeachSource::Setup setup;
    setup.files = findScenes({scene}).front();
    setup.input = readScene(setup.files);
    setup.model = readLabelModel(model).model;
    setup.model_name = model;
    setup.corrections = corrections;
    setup.options.name = sceneName(corrections);
    setup.read_only = read_only;
    return setup;
  }

  PageEvents events_;
  TeachSource source_;
  TeachRoutes routes_{source_, events_};
  HttpServer server_{"127.0.0.1", 0};
  Gate gate_{"127.0.0.1", server_.port()};
};

}  // namespace urban_nav::testing
