// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace urban_nav {

/// A request as it came: nothing in it is checked but that it is HTTP.
struct HttpRequest {
  std::string method;  ///< "GET"
  std::string path;    ///< decoded, without the query
  std::multimap<std::string, std::string> query;
  std::multimap<std::string, std::string> headers;  ///< names in lower case
  std::string body;                                 ///< filled in for a POST that was admitted

  /// Returns the values of a header; `name` in lower case.
  std::vector<std::string> header(const std::string& name) const;
  /// Returns the values of a parameter in the address.
  std::vector<std::string> parameter(const std::string& name) const;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  /// For an answer without end: called again and again for what comes next, and may block for about a second; empty
  /// text is a pause, false the end. Null: `body` is all.
  std::function<bool(std::string& next)> stream = {};
};

/// A server of HTTP/1.1 on one address of this machine. Every request goes to `admit` first, without its body; what it
/// answers is the answer. Requests are bounded in size. Handlers are called from several threads at once.
class HttpServer {
 public:
  /// Returns an answer for a request that is refused; null for one that goes on to `handle`.
  using Admission = std::function<std::unique_ptr<HttpAnswer>(const HttpRequest&)>;
  using Handler = std::function<HttpAnswer(const HttpRequest&)>;

  /// Binds the port, 0: a free one. Throws UserError if it is in use or this machine does not have the address, and if
  /// the program was built without its HTTP library.
  HttpServer(const std::string& address, int port);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Answers requests in threads of its own from now on.
  void start(Admission admit, Handler handle);
  /// Returns whether requests are being answered.
  bool isRunning() const;
  /// Ends: answers that have begun are finished, streams are cut off. Blocks until all threads have ended.
  void stop();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The largest body of a request, bytes.
constexpr std::size_t kLargestBody = 64 << 10;

}  // namespace urban_nav
