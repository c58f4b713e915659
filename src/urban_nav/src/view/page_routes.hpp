// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/http_server.hpp"
#include "view/map_source.hpp"
#include "view/page_events.hpp"

namespace urban_nav {

/// Answers the requests of the page, which the gate has admitted: the page itself at `/`, and below `/api/` what it
/// loads and the edits that it posts. Errors of the source are answered as `{"error": sentence}`: 400 for the user's,
/// 409 for the data's. No request names a file. Thread-safe.
class PageRoutes {
 public:
  /// Both must outlive this object.
  PageRoutes(MapSource& source, PageEvents& events) : source_(source), events_(events) {}

  HttpAnswer answer(const HttpRequest& request) const;

 private:
  HttpAnswer get(const HttpRequest& request) const;
  HttpAnswer post(const HttpRequest& request) const;
  HttpAnswer follow() const;

  MapSource& source_;
  PageEvents& events_;
};

/// Returns the page with its scripts and style in it. It loads nothing but what this server offers.
std::string viewPage();

}  // namespace urban_nav
