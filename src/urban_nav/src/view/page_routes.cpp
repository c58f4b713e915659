// SPDX-License-Identifier: BSD-3-Clause
#include "view/page_routes.hpp"

#include <cmath>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "view/page_answers.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr double kLongestSession = 1e9;  // s

double secondsIn(const HttpRequest& request) {
  const auto seconds = urban_nav_core::parseNumber(wordIn(request, "seconds"));
  if (!seconds || !std::isfinite(*seconds) || std::abs(*seconds) > kLongestSession)
    throw UserError("seconds", "is not a time within a session", "seconds=S in the address");
  return *seconds;
}

/// Returns the tiles that a request selects: all without `extent` and `budget`.
TileSelection selectionIn(const HttpRequest& request) {
  TileSelection selection;
  if (!request.parameter("budget").empty()) selection.budget = static_cast<std::uint64_t>(numberIn(request, "budget"));
  if (request.parameter("extent").empty()) return selection;
  selection.extent.emplace();
  const std::string text = wordIn(request, "extent");
  const std::vector<std::string_view> words = urban_nav_core::splitAt(text, ',');
  const UserError wrong("extent", text + " is not an extent", "extent=X0,Y0,X1,Y1 (m) in the address");
  if (words.size() != selection.extent->size()) throw wrong;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto number = urban_nav_core::parseNumber(words[i]);
    if (!number || !std::isfinite(*number)) throw wrong;
    (*selection.extent)[i] = *number;
  }
  return selection;
}

}  // namespace

std::string viewPage() {
  return makePage("page.html", {"camera.js", "text.js", "server.js", "lists.js", "explanation.js", "plan.js",
                                "points.js", "tiles.js", "tile_view.js", "page.js"});
}

HttpAnswer PageRoutes::answer(const HttpRequest& request) const {
  return answerSafely(request,
                      [this](const HttpRequest& each) { return each.method == "POST" ? post(each) : get(each); });
}

HttpAnswer PageRoutes::get(const HttpRequest& request) const {
  if (request.path == "/") return {200, "text/html; charset=utf-8", viewPage()};
  if (request.path == "/api/state") return asJson(source_.state());
  if (request.path == "/api/paths") return {200, "application/octet-stream", source_.paths()};
  if (request.path == "/api/compared") return {200, "application/octet-stream", source_.comparedPlaces()};
  if (request.path == "/api/tiles") return asJson(source_.tiles(selectionIn(request)).print());
  if (request.path == "/api/tile") return tile(request);
  if (request.path == "/api/moves") return {200, "application/octet-stream", source_.moves()};
  if (request.path == "/api/moment") return asJson(source_.explainMoment(wordIn(request, "t")).print());
  if (request.path == "/api/why") return asJson(source_.explain(numberIn(request, "id")).print());
  if (request.path == "/api/view")
    return asPicture(source_.view(static_cast<std::size_t>(numberIn(request, "session")), secondsIn(request)));
  if (request.path == "/api/try")
    return asJson(source_.tryMeasurement(wordIn(request, "t1"), wordIn(request, "t2")).print());
  if (request.path == "/api/picture")
    return asPicture(source_.picture(numberIn(request, "id"), static_cast<std::size_t>(numberIn(request, "number"))));
  if (request.path == "/api/now") return asJson(asData(events_.state()));
  if (request.path == "/api/events" && request.method == "GET") return followEvents(events_);
  return notThere();
}

HttpAnswer PageRoutes::tile(const HttpRequest& request) const {
  const auto name = laser_mapper::parseLevelTile(wordIn(request, "tile"));
  if (!name) throw UserError("tile", "is not level/x,y", "a tile of /api/tiles");
  std::optional<std::string> packed = source_.tile(static_cast<std::size_t>(numberIn(request, "set")), *name);
  if (!packed) return notThere();
  HttpAnswer answer{200, "application/octet-stream", std::move(*packed)};
  answer.is_zlib = true;
  return answer;
}

HttpAnswer PageRoutes::post(const HttpRequest& request) const {
  if (request.path != "/api/edit") return notThere();
  return asJson(source_.edit(parseEditWords(request.body)).print());
}

}  // namespace urban_nav
