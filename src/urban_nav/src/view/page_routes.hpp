// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/http_server.hpp"
#include "view/map_source.hpp"
#include "view/page_events.hpp"

namespace urban_nav {

/// Answers the requests of the page admitted by the gate: the page at `/`, and its data and edits below `/api/`. Errors
/// of the source are answered as `{"error": sentence}` with status 400 for UserError and 409 for DataError. No request
/// names a file. Thread-safe.
class PageRoutes {
 public:
  /// Both must outlive this object.
  PageRoutes(MapSource& source, PageEvents& events) : source_(source), events_(events) {}

  HttpAnswer answer(const HttpRequest& request) const;

 private:
  HttpAnswer get(const HttpRequest& request) const;
  HttpAnswer tile(const HttpRequest& request) const;
  HttpAnswer post(const HttpRequest& request) const;

  MapSource& source_;
  PageEvents& events_;
};

/// Returns the page with embedded scripts and style. It loads only from this server.
std::string viewPage();

}  // namespace urban_nav
