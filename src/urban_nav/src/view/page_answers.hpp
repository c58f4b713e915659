// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>

#include "view/http_server.hpp"
#include "view/page_events.hpp"

namespace urban_nav {

HttpAnswer asJson(const std::string& json, int status = 200);
/// Returns {"error": sentence}.
HttpAnswer asError(int status, const std::string& sentence);
HttpAnswer notThere();
/// Returns a JPEG; status 204 without one.
HttpAnswer asPicture(const std::optional<std::string>& jpeg);
/// Returns the states of a page as server-sent events. `events` must outlive the answer.
HttpAnswer followEvents(PageEvents& events);

/// Answers a request; errors are answered as asError(): 400 for UserError, 409 for DataError, 500 for others.
HttpAnswer answerSafely(const HttpRequest& request, const std::function<HttpAnswer(const HttpRequest&)>& answer);

/// Return a parameter of the address. Throw UserError if it is missing, repeated, too long, or not such a number.
std::int64_t numberIn(const HttpRequest& request, const std::string& name);
std::string wordIn(const HttpRequest& request, const std::string& name);

/// Returns a page: the file `page` of src/urban_nav/web, with the style and these scripts embedded. It loads only from
/// this server.
std::string makePage(const char* page, std::initializer_list<const char*> scripts);

}  // namespace urban_nav
