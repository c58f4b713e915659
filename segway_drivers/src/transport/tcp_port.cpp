// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "segway_drivers/transport/port.hpp"
#include "transport/port_descriptor.hpp"

namespace segway_drivers {

namespace {

constexpr int kConnectTimeout = 1000;  // ms

/// Returns the descriptor of a connection to the first address that answers; otherwise -1, and sets `error`.
int connectTcp(const addrinfo* addresses, std::string& error) {
  for (const addrinfo* each = addresses; each != nullptr; each = each->ai_next) {
    const int descriptor =
        ::socket(each->ai_family, each->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, each->ai_protocol);
    if (descriptor < 0) continue;
    int failure = ::connect(descriptor, each->ai_addr, each->ai_addrlen) == 0 ? 0 : errno;
    if (failure == EINPROGRESS) {
      pollfd waiting{descriptor, POLLOUT, 0};
      socklen_t size = sizeof(failure);
      if (::poll(&waiting, 1, kConnectTimeout) != 1) failure = ETIMEDOUT;
      else ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &failure, &size);
    }
    if (failure == 0) return descriptor;
    error = std::strerror(failure);
    ::close(descriptor);
  }
  return -1;
}

}  // namespace

std::unique_ptr<Port> openTcpPort(const std::string& host, int port, std::string& error) {
  addrinfo wish{};
  wish.ai_socktype = SOCK_STREAM;
  addrinfo* addresses = nullptr;
  const int failure = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wish, &addresses);
  if (failure != 0) {
    error = ::gai_strerror(failure);
    return nullptr;
  }
  const int descriptor = connectTcp(addresses, error);
  ::freeaddrinfo(addresses);
  return descriptor < 0 ? nullptr : std::make_unique<DescriptorPort>(descriptor);
}

}  // namespace segway_drivers
