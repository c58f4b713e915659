// SPDX-License-Identifier: BSD-3-Clause
#include "view/gate.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

constexpr const char* kTokenHeader = "x-urban-nav-token";
constexpr std::size_t kTokenLength = 32;  // 192 bits
constexpr int kHttpPort = 80;             // which may be omitted in a host

std::string inLowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::unique_ptr<HttpAnswer> refuse(int status, const std::string& why) {
  auto answer = std::make_unique<HttpAnswer>();
  answer->status = status;
  answer->body = why;
  return answer;
}

}  // namespace

std::string drawToken() {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  std::array<unsigned char, kTokenLength> bytes{};
  for (std::size_t drawn = 0; drawn < bytes.size();) {
    const ssize_t count = ::getrandom(bytes.data() + drawn, bytes.size() - drawn, 0);
    if (count > 0) drawn += static_cast<std::size_t>(count);
    else if (errno != EINTR) throw urban_nav_core::DataError("", "the system has no random numbers", "");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += kDigits[byte & 63U];
  return token;
}

bool areEqualInConstantTime(const std::string& one, const std::string& other) {
  unsigned difference = one.size() == other.size() ? 0U : 1U;
  for (std::size_t i = 0; i < one.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(one[i]) ^
                                        static_cast<unsigned char>(other.empty() ? '\0' : other[i % other.size()]));
  return difference == 0U;
}

Gate::Gate(const std::string& address, int port) : token_(drawToken()) {
  const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  for (const std::string& name : {host, std::string("localhost")}) {
    hosts_.push_back(inLowerCase(name) + ":" + std::to_string(port));
  }
  if (port == kHttpPort)
    for (const std::string& name : {host, std::string("localhost")}) hosts_.push_back(inLowerCase(name));
}

bool Gate::isTrusted(const HttpRequest& request) const {
  const auto is_ours = [&](const std::string& host) {
    return std::find(hosts_.begin(), hosts_.end(), inLowerCase(host)) != hosts_.end();
  };
  const std::vector<std::string> hosts = request.header("host");
  if (hosts.size() != 1 || !is_ours(hosts.front())) return false;
  for (const std::string& origin : request.header("origin"))
    if (origin.rfind("http://", 0) != 0 || !is_ours(origin.substr(7))) return false;
  std::vector<std::string> tokens = request.header(kTokenHeader);
  for (const std::string& token : request.parameter("token")) tokens.push_back(token);
  return tokens.size() == 1 && areEqualInConstantTime(tokens.front(), token_);
}

std::unique_ptr<HttpAnswer> Gate::admit(const HttpRequest& request) const {
  if (!isTrusted(request)) return refuse(403, "");
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST")
    return refuse(405, "GET, HEAD or POST\n");
  if (!request.header("range").empty()) return refuse(416, "");
  if (request.method == "POST") {
    const std::vector<std::string> types = request.header("content-type");
    if (types.size() != 1 || inLowerCase(types.front()).rfind("application/json", 0) != 0)
      return refuse(415, "a body of type application/json\n");
    if (!request.header("content-encoding").empty()) return refuse(415, "a body that is not compressed\n");
  }
  return nullptr;
}

}  // namespace urban_nav
