// SPDX-License-Identifier: BSD-3-Clause
#include "view/http_server.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <thread>

#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"

#ifdef URBAN_NAV_HTTPLIB
#include <httplib.h>
#include <sys/socket.h>
#endif

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

std::vector<std::string> valuesUnder(const std::multimap<std::string, std::string>& all, const std::string& name) {
  std::vector<std::string> values;
  const auto [first, last] = all.equal_range(name);
  for (auto each = first; each != last; ++each) values.push_back(each->second);
  return values;
}

}  // namespace

std::vector<std::string> HttpRequest::header(const std::string& name) const { return valuesUnder(headers, name); }
std::vector<std::string> HttpRequest::parameter(const std::string& name) const { return valuesUnder(query, name); }

#ifdef URBAN_NAV_HTTPLIB

namespace {

constexpr std::size_t kServerThreads = 32;  // a stream occupies one as long as its page is open
constexpr std::size_t kMostStreams = 16;
constexpr std::size_t kRequestsPerConnection = 10000;
constexpr int kKeepAlive = 3;     // s for the first byte of a request until a connection ends; stop() waits as long
constexpr int kReadPatience = 5;  // s for the next bytes of a request

HttpRequest toRequest(const httplib::Request& given) {
  HttpRequest request;
  request.method = given.method;
  request.path = given.path;
  request.query = {given.params.begin(), given.params.end()};
  for (const auto& [name, value] : given.headers) {
    std::string key = name;
    std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::tolower(c); });
    request.headers.emplace(std::move(key), value);
  }
  request.body = given.body;
  return request;
}

/// Headers of every answer, against framing, reading and caching by other pages.
const httplib::Headers& commonHeaders() {
  static const httplib::Headers all = {{"Cache-Control", "no-store"},
                                       {"Cross-Origin-Opener-Policy", "same-origin"},
                                       {"Cross-Origin-Resource-Policy", "same-origin"},
                                       {"Referrer-Policy", "no-referrer"},
                                       {"X-Content-Type-Options", "nosniff"},
                                       {"X-Frame-Options", "DENY"}};
  return all;
}

}  // namespace

class HttpServer::Implementation {
 public:
  Implementation(const std::string& address, int port) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kServerThreads); };
    server_.set_keep_alive_timeout(kKeepAlive);
    server_.set_keep_alive_max_count(kRequestsPerConnection);
    server_.set_read_timeout(kReadPatience);
    server_.set_payload_max_length(kLargestBody);
    server_.set_tcp_nodelay(true);
    server_.set_default_headers(commonHeaders());
    // The default options of the library would let two servers share a port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    if (port == 0) port_ = server_.bind_to_any_port(address);
    else if (server_.bind_to_port(address, port)) port_ = port;
    if (port_ <= 0)
      throw UserError("port " + std::to_string(port) + " of " + address, "cannot be opened: in use or reserved",
                      "--port with another number, or --port 0 for a free one; --address with one of this machine");
  }
  ~Implementation() { stop(); }

  void start(Admission admit, Handler handle) {
    admit_ = std::move(admit);
    handle_ = std::move(handle);
    server_.set_pre_routing_handler([this](const httplib::Request& given, httplib::Response& response) {
      return beforeBody(given, response) ? httplib::Server::HandlerResponse::Handled
                                         : httplib::Server::HandlerResponse::Unhandled;
    });
    server_.Post("/api/[a-z]{1,20}", [this](const httplib::Request& given, httplib::Response& response) {
      fill(response, handle_(toRequest(given)));
    });
    server_.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
      response.status = 500;
      response.set_content("", "text/plain");
    });
    listener_ = urban_nav_core::namedThread("http_server", [this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void stop() {
    stopping_ = true;
    server_.stop();
    if (listener_.joinable()) listener_.join();
  }
  int port() const { return port_; }
  bool isRunning() const { return server_.is_running(); }

 private:
  /// Answers requests without a body; returns false for an admitted POST.
  bool beforeBody(const httplib::Request& given, httplib::Response& response) {
    const HttpRequest request = toRequest(given);
    if (const std::unique_ptr<HttpAnswer> refusal = admit_(request)) {
      response.set_header("Connection", "close");  // a body that was not read would be taken for the next request
      fill(response, *refusal);
      return true;
    }
    if (request.method == "POST") return false;
    HttpAnswer answer;
    try {
      answer = handle_(request);
    } catch (const std::exception&) {
      answer.status = 500;
    }
    fill(response, std::move(answer));
    return true;
  }

  void fill(httplib::Response& response, HttpAnswer answer) {
    response.status = answer.status;
    if (!answer.stream) {
      if (answer.is_zlib) response.set_header("Content-Encoding", "deflate");
      response.set_content(answer.body, answer.type);
      return;
    }
    if (++streams_ > kMostStreams) {
      --streams_;
      response.status = 503;
      return;
    }
    response.set_chunked_content_provider(
        answer.type,
        [this, stream = std::move(answer.stream)](std::size_t, httplib::DataSink& sink) {
          std::string next;
          if (stopping_ || !stream(next)) return false;
          return next.empty() || sink.write(next.data(), next.size());
        },
        [this](bool) { --streams_; });
  }

  httplib::Server server_;
  Admission admit_;
  Handler handle_;
  std::thread listener_;
  std::atomic<bool> stopping_{false};
  std::atomic<std::size_t> streams_{0};
  int port_ = 0;
};

#else

class HttpServer::Implementation {
 public:
  Implementation(const std::string&, int) {
    throw UserError("urban_nav view", "built without cpp-httplib", "a build with the package libcpp-httplib-dev");
  }
  void start(const Admission&, const Handler&) {}
  void stop() {}
  int port() const { return 0; }
  bool isRunning() const { return false; }
};

#endif

HttpServer::HttpServer(const std::string& address, int port)
    : implementation_(std::make_unique<Implementation>(address, port)) {}
HttpServer::~HttpServer() = default;
int HttpServer::port() const { return implementation_->port(); }
void HttpServer::start(Admission admit, Handler handle) { implementation_->start(std::move(admit), std::move(handle)); }
bool HttpServer::isRunning() const { return implementation_->isRunning(); }
void HttpServer::stop() { implementation_->stop(); }

}  // namespace urban_nav
