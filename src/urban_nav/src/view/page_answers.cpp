// SPDX-License-Identifier: BSD-3-Clause
#include "view/page_answers.hpp"

#include "base/json.hpp"
#include "base/web_files.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "view/gate.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kLongestText = 1024;

void replaceFirst(std::string& text, const std::string& mark, const std::string& content) {
  const std::size_t at = text.find(mark);
  if (at != std::string::npos) text.replace(at, mark.size(), content);
}

}  // namespace

HttpAnswer asJson(const std::string& json, int status) { return {status, "application/json", json}; }

HttpAnswer asError(int status, const std::string& sentence) {
  return asJson(Json::object({{"error", sentence}}).print(), status);
}

HttpAnswer notThere() { return {404, "text/plain; charset=utf-8", "not found\n"}; }

HttpAnswer asPicture(const std::optional<std::string>& jpeg) {
  return jpeg ? HttpAnswer{200, "image/jpeg", *jpeg} : HttpAnswer{204, "image/jpeg", ""};
}

HttpAnswer followEvents(PageEvents& events) {
  HttpAnswer answer;
  answer.type = "text/event-stream";
  answer.stream = [&events, known = std::int64_t{-1}](std::string& next) mutable {
    const PageEvents::State state = events.wait(known);
    // Server-sent events (HTML standard, section 9.2). Periodic comments detect a closed page.
    next = state.number == known ? ":\n\n" : "data: " + asData(state) + "\n\n";
    known = state.number;
    return true;
  };
  return answer;
}

HttpAnswer answerSafely(const HttpRequest& request, const std::function<HttpAnswer(const HttpRequest&)>& answer) {
  try {
    return answer(request);
  } catch (const UserError& error) {
    return asError(400, error.what());
  } catch (const urban_nav_core::DataError& error) {
    return asError(409, error.what());
  } catch (const std::exception& error) {
    return asError(500, error.what());
  }
}

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

std::string makePage(const char* page, std::initializer_list<const char*> scripts) {
  std::string text(webFile("shell.html"));
  const std::string nonce = drawToken();
  replaceFirst(text, "NONCE", nonce);
  replaceFirst(text, "NONCE", nonce);
  replaceFirst(text, "<!-- main -->", std::string(webFile(page)));
  replaceFirst(text, "<!-- style -->",
               "<style nonce=\"" + nonce + "\">" + std::string(webFile("page.css")) + "</style>");
  replaceFirst(text, "<!-- scripts -->", "<script nonce=\"" + nonce + "\">" + webFiles(scripts) + "</script>");
  return text;
}

}  // namespace urban_nav
