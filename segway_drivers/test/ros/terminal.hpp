// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers::test {

/// Device side of a pseudo-terminal with a link that the driver opens.
class Terminal {
 public:
  explicit Terminal(const std::filesystem::path& link) : link_(link) {
    std::filesystem::create_directories(link_.parent_path());
    std::filesystem::remove(link_);
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) return;
    const std::string name = ::ptsname(master_);
    slave_ = ::open(name.c_str(), O_RDWR | O_NOCTTY);
    termios settings{};
    tcgetattr(slave_, &settings);
    cfmakeraw(&settings);
    tcsetattr(slave_, TCSANOW, &settings);
    std::filesystem::create_symlink(name, link_);
  }
  ~Terminal() {
    std::filesystem::remove(link_);
    std::error_code not_empty;
    std::filesystem::remove(link_.parent_path(), not_empty);
    ::close(slave_);
    ::close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void write(const Bytes& bytes) {
    if (::write(master_, bytes.data(), bytes.size()) < 0) return;  // full: dropped
  }
  Bytes read() {
    std::array<std::uint8_t, 4096> buffer;
    const ssize_t count = ::read(master_, buffer.data(), buffer.size());
    return count > 0 ? Bytes(buffer.begin(), buffer.begin() + count) : Bytes();
  }

 private:
  std::filesystem::path link_;
  int master_ = -1, slave_ = -1;
};

}  // namespace segway_drivers::test
