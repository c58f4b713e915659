// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_sim/device/device_server.hpp"

namespace urban_nav_sim {

namespace {

DeviceBytes readAvailable(int descriptor) {
  std::array<std::uint8_t, 4096> buffer;
  const ssize_t count = descriptor < 0 ? 0 : ::read(descriptor, buffer.data(), buffer.size());
  return count > 0 ? DeviceBytes(buffer.begin(), buffer.begin() + count) : DeviceBytes();
}

int baudOfSpeed(speed_t speed) {
  switch (speed) {
    case B4800: return 4800;
    case B9600: return 9600;
    case B19200: return 19200;
    case B38400: return 38400;
    case B57600: return 57600;
    case B115200: return 115200;
    case B230400: return 230400;
    case B460800: return 460800;
    case B500000: return 500000;
    default: return 0;
  }
}

class PseudoTerminal : public DeviceLink {
 public:
  explicit PseudoTerminal(std::string path) : path_(std::move(path)) { plug(); }
  ~PseudoTerminal() override { unplug(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  DeviceBytes read() override { return readAvailable(master_); }
  void write(const DeviceBytes& bytes) override {
    if (::write(master_, bytes.data(), bytes.size()) < 0) return;  // full: dropped
  }
  int hostBaud() const override {
    termios settings{};
    return master_ >= 0 && tcgetattr(master_, &settings) == 0 ? baudOfSpeed(cfgetospeed(&settings)) : 0;
  }
  void setPlugged(bool plugged) override {
    if (plugged) plug();
    else unplug();
  }

 private:
  void plug() {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    std::array<char, 128> name{};
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
        ::ptsname_r(master_, name.data(), name.size()) != 0)
      throw urban_nav_core::DataError(path_, "no pseudo-terminal: " + std::string(std::strerror(errno)), "");
    // Kept open, so that the device persists while no host has it open.
    slave_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    tcgetattr(slave_, &settings);
    cfmakeraw(&settings);
    tcsetattr(slave_, TCSANOW, &settings);
    std::error_code ignored;  // an error is reported on creating the link
    std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), ignored);
    const std::string fresh = path_ + ".new";
    ::unlink(fresh.c_str());
    if (::symlink(name.data(), fresh.c_str()) != 0 || ::rename(fresh.c_str(), path_.c_str()) != 0)
      throw urban_nav_core::DataError(path_, "no link: " + std::string(std::strerror(errno)), "");
  }
  void unplug() {
    if (master_ < 0) return;
    ::unlink(path_.c_str());
    ::close(slave_);
    ::close(master_);
    master_ = slave_ = -1;
  }

  std::string path_;
  int master_ = -1, slave_ = -1;
};

class TcpServer : public DeviceLink {
 public:
  TcpServer(int port, std::string greeting) : greeting_(std::move(greeting)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
        ::listen(listener_, 1) != 0)
      throw urban_nav_core::DataError("--tcp " + std::to_string(port), std::strerror(errno), "");
  }
  ~TcpServer() override {
    setPlugged(false);
    ::close(listener_);
  }
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;

  DeviceBytes read() override {
    if (client_ < 0) {
      client_ = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (client_ >= 0) write(DeviceBytes(greeting_.begin(), greeting_.end()));
    }
    return readAvailable(client_);
  }
  void write(const DeviceBytes& bytes) override {
    if (client_ >= 0 && ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN)
      setPlugged(false);
  }
  int hostBaud() const override { return client_ < 0 ? 0 : 100'000'000; }
  void setPlugged(bool plugged) override {
    if (plugged || client_ < 0) return;
    ::close(client_);
    client_ = -1;
  }

 private:
  std::string greeting_;
  int listener_ = -1, client_ = -1;
};

}  // namespace

std::unique_ptr<DeviceLink> openPseudoTerminal(const std::string& path) {
  return std::make_unique<PseudoTerminal>(path);
}
std::unique_ptr<DeviceLink> openTcpServer(int port, const std::string& greeting) {
  return std::make_unique<TcpServer>(port, greeting);
}

}  // namespace urban_nav_sim
