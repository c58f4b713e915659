// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "segway_drivers/transport/port.hpp"
#include "transport/port_descriptor.hpp"

namespace segway_drivers {

namespace {

speed_t speedOfBaud(int baud) {
  switch (baud) {
    case 4800: return B4800;
    case 9600: return B9600;
    case 19200: return B19200;
    case 38400: return B38400;
    case 57600: return B57600;
    case 115200: return B115200;
    case 230400: return B230400;
    case 460800: return B460800;
    case 500000: return B500000;
    case 921600: return B921600;
    default: return B0;
  }
}

class SerialPort : public DescriptorPort {
 public:
  explicit SerialPort(int descriptor) : DescriptorPort(descriptor) {
    termios settings{};
    tcgetattr(descriptor, &settings);
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    tcsetattr(descriptor, TCSANOW, &settings);
    tcflush(descriptor, TCIOFLUSH);
    ioctl(descriptor, TIOCEXCL);
    setLowLatency();
  }
  void setBaud(int baud) override {
    termios settings{};
    if (tcgetattr(descriptor(), &settings) != 0) return;
    const speed_t speed = speedOfBaud(baud);
    if (speed == B0 || (cfgetospeed(&settings) == speed && cfgetispeed(&settings) == speed)) return;
    cfsetispeed(&settings, speed);
    cfsetospeed(&settings, speed);
    tcsetattr(descriptor(), TCSANOW, &settings);
    tcflush(descriptor(), TCIFLUSH);
  }
  std::string remark() const override { return remark_; }

 private:
  /// The latency timer of a USB adapter delays bytes by up to 16 ms.
  void setLowLatency() {
    serial_struct serial{};
    if (ioctl(descriptor(), TIOCGSERIAL, &serial) != 0) {
      remark_ = "low latency cannot be set (" + std::string(std::strerror(errno)) + ")";
      return;
    }
    serial.flags |= ASYNC_LOW_LATENCY;
    if (ioctl(descriptor(), TIOCSSERIAL, &serial) != 0)
      remark_ = "low latency cannot be set (" + std::string(std::strerror(errno)) + "): stamps may be 16 ms late";
  }

  std::string remark_;
};

}  // namespace

std::unique_ptr<Port> openSerialPort(const std::string& path, std::string& error) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    error = std::strerror(errno);
    return nullptr;
  }
  if (::isatty(descriptor) == 0) {
    error = "not a serial port";
    ::close(descriptor);
    return nullptr;
  }
  return std::make_unique<SerialPort>(descriptor);
}

}  // namespace segway_drivers
