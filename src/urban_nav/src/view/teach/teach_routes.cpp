// SPDX-License-Identifier: BSD-3-Clause
#include "view/teach/teach_routes.hpp"

namespace urban_nav {

std::string teachPage() {
  return makePage("teach.html",
                  {"camera.js", "text.js", "server.js", "points.js", "labelled.js", "marks.js", "teach.js"});
}

HttpAnswer TeachRoutes::answer(const HttpRequest& request) const {
  return answerSafely(request, [this](const HttpRequest& each) { return answerAdmitted(each); });
}

HttpAnswer TeachRoutes::answerAdmitted(const HttpRequest& request) const {
  if (request.method == "POST") {
    if (request.path != "/api/correct") return notThere();
    return asJson(source_.change(parseTeachWords(request.body)).print());
  }
  if (request.path == "/") return {200, "text/html; charset=utf-8", teachPage()};
  if (request.path == "/api/state") return asJson(source_.state());
  if (request.path == "/api/cloud") return {200, "application/octet-stream", source_.cloud()};
  if (request.path == "/api/answers") return {200, "application/octet-stream", source_.answers()};
  if (request.path == "/api/image") return asPicture(source_.image());
  if (request.path == "/api/now") return asJson(asData(events_.state()));
  if (request.path == "/api/events" && request.method == "GET") return followEvents(events_);
  return notThere();
}

}  // namespace urban_nav
