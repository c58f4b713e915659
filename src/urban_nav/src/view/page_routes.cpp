// SPDX-License-Identifier: BSD-3-Clause
#include "view/page_routes.hpp"

#include <cmath>

#include "base/web_files.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "view/gate.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kLongestText = 1024;
constexpr double kLongestSession = 1e9;  // s

HttpAnswer asJson(const std::string& json, int status = 200) { return {status, "application/json", json}; }

HttpAnswer asError(int status, const std::string& sentence) {
  return asJson(Json::object({{"error", sentence}}).print(), status);
}

HttpAnswer notThere() { return {404, "text/plain; charset=utf-8", "not found\n"}; }

/// Returns an integer parameter of the address.
std::int64_t numberIn(const HttpRequest& request, const std::string& name) {
  const std::vector<std::string> values = request.parameter(name);
  const auto number = values.size() == 1 ? urban_nav_core::parseInteger(values.front()) : std::nullopt;
  if (!number || *number < 0) throw UserError(name, "is missing or not an integer", name + "=N in the address");
  return *number;
}

std::string wordIn(const HttpRequest& request, const std::string& name) {
  const std::vector<std::string> values = request.parameter(name);
  if (values.size() != 1 || values.front().size() > kLongestText)
    throw UserError(name, "is missing or too long", name + "=TEXT in the address");
  return values.front();
}

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

/// Returns a JPEG; status 204 without one.
HttpAnswer asPicture(const std::optional<std::string>& jpeg) {
  return jpeg ? HttpAnswer{200, "image/jpeg", *jpeg} : HttpAnswer{204, "image/jpeg", ""};
}

void replaceFirst(std::string& text, const std::string& mark, const std::string& content) {
  const std::size_t at = text.find(mark);
  if (at != std::string::npos) text.replace(at, mark.size(), content);
}

}  // namespace

std::string viewPage() {
  std::string page(webFile("page.html"));
  const std::string nonce = drawToken();
  replaceFirst(page, "NONCE", nonce);
  replaceFirst(page, "NONCE", nonce);
  replaceFirst(page, "<!-- style -->",
               "<style nonce=\"" + nonce + "\">" + std::string(webFile("page.css")) + "</style>");
  replaceFirst(page, "<!-- scripts -->",
               "<script nonce=\"" + nonce + "\">" +
                   webFiles({"camera.js", "text.js", "server.js", "lists.js", "explanation.js", "plan.js", "points.js",
                             "tiles.js", "tile_view.js", "page.js"}) +
                   "</script>");
  return page;
}

HttpAnswer PageRoutes::answer(const HttpRequest& request) const {
  try {
    return request.method == "POST" ? post(request) : get(request);
  } catch (const UserError& error) {
    return asError(400, error.what());
  } catch (const urban_nav_core::DataError& error) {
    return asError(409, error.what());
  } catch (const std::exception& error) {
    return asError(500, error.what());
  }
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
  if (request.path == "/api/events" && request.method == "GET") return follow();
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

HttpAnswer PageRoutes::follow() const {
  HttpAnswer answer;
  answer.type = "text/event-stream";
  answer.stream = [this, known = std::int64_t{-1}](std::string& next) mutable {
    const PageEvents::State state = events_.wait(known);
    // Server-sent events (HTML standard, section 9.2). Periodic comments detect a closed page.
    next = state.number == known ? ":\n\n" : "data: " + asData(state) + "\n\n";
    known = state.number;
    return true;
  };
  return answer;
}

}  // namespace urban_nav
