// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <string>

namespace urban_nav::testing {

/// A connection to a port of this machine that sends any bytes.
class RawConnection {
 public:
  explicit RawConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{120, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  int socket() const { return socket_; }
  bool isConnected() const { return connected_; }
  void send(const std::string& bytes) const {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return;
      sent += static_cast<std::size_t>(count);
    }
  }
  /// Reads until a text has come, or the end, or for a minute.
  std::string readUntil(const std::string& text) const {
    std::string all;
    char buffer[4096];
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (all.find(text) == std::string::npos && std::chrono::steady_clock::now() < end) {
      const ssize_t count = ::recv(socket_, buffer, sizeof buffer, 0);
      if (count <= 0) break;
      all.append(buffer, static_cast<std::size_t>(count));
    }
    return all;
  }
  std::string readAll() const { return readUntil("\x01 never \x01"); }

 private:
  int socket_;
  bool connected_ = false;
};

/// An answer as it came.
struct RawAnswer {
  int status = 0;
  std::string head, body;
};

inline RawAnswer parseAnswer(const std::string& bytes) {
  RawAnswer answer;
  const std::size_t end = bytes.find("\r\n\r\n");
  if (bytes.rfind("HTTP/1.1 ", 0) != 0 || end == std::string::npos) return answer;
  answer.status = std::stoi(bytes.substr(9, 3));
  answer.head = bytes.substr(0, end);
  answer.body = bytes.substr(end + 4);
  return answer;
}

/// Sends a request of one connection. `headers`: whole lines with their ends.
inline RawAnswer sendRequest(int port, const std::string& method, const std::string& target,
                             const std::string& headers = "", const std::string& body = "") {
  const RawConnection connection(port);
  std::string bytes = method + " " + target + " HTTP/1.1\r\nConnection: close\r\n" + headers;
  if (headers.find("Host:") == std::string::npos) bytes += "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  if (!body.empty()) bytes += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  connection.send(bytes + "\r\n" + body);
  return parseAnswer(connection.readAll());
}

}  // namespace urban_nav::testing
