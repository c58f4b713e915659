// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace urban_nav {

/// A request without any checks beyond HTTP syntax.
struct HttpRequest {
  std::string method;  ///< "GET"
  std::string path;    ///< decoded, without the query
  std::multimap<std::string, std::string> query;
  std::multimap<std::string, std::string> headers;  ///< names in lower case
  std::string body;                                 ///< of an admitted POST

  /// Returns the values of a header; `name` in lower case.
  std::vector<std::string> header(const std::string& name) const;
  /// Returns the values of a parameter in the address.
  std::vector<std::string> parameter(const std::string& name) const;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  bool is_zlib = false;  ///< `body` is zlib data, which the browser unpacks
  /// For a streamed answer: called repeatedly for the next part, and may block for about a second; empty text is a
  /// pause, false the end. Null: the answer is `body`.
  std::function<bool(std::string& next)> stream = {};
};

/// An HTTP/1.1 server on one address of this machine. Each request is first passed to `admit`, without its body.
/// Requests are bounded in size. Handlers are called from several threads concurrently.
class HttpServer {
 public:
  /// Returns the answer for a refused request; null to pass the request to `handle`.
  using Admission = std::function<std::unique_ptr<HttpAnswer>(const HttpRequest&)>;
  using Handler = std::function<HttpAnswer(const HttpRequest&)>;

  /// Binds the port, 0: a free one. Throws UserError if it is in use or this machine does not have the address, and if
  /// the program was built without its HTTP library.
  HttpServer(const std::string& address, int port);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Starts the threads that answer requests.
  void start(Admission admit, Handler handle);
  /// Returns whether requests are being answered.
  bool isRunning() const;
  /// Stops: finishes answers in progress, ends streams. Blocks until all threads have ended.
  void stop();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The largest body of a request, bytes.
constexpr std::size_t kLargestBody = 64 << 10;

}  // namespace urban_nav
