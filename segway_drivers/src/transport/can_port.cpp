// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cstring>

#include "segway_drivers/segway_rmp/can_frame.hpp"
#include "segway_drivers/transport/port.hpp"
#include "transport/port_descriptor.hpp"

#if defined(__linux__) && __has_include(<linux/can.h>)
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace segway_drivers {

namespace {

/// SocketCAN with the format of the USB connection: each frame is one packet, so that one driver serves both.
class CanPort : public DescriptorPort {
 public:
  explicit CanPort(int descriptor) : DescriptorPort(descriptor) {}

  ReadResult read(std::uint8_t* buffer, std::size_t size, TimeNs timeout) override {
    can_frame frame{};
    ReadResult result = DescriptorPort::read(reinterpret_cast<std::uint8_t*>(&frame), sizeof(frame), timeout);
    if (result.outcome != Outcome::Data) return result;
    result.size = 0;
    if ((frame.can_id & (CAN_ERR_FLAG | CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0 || frame.can_dlc != 8) return result;
    CanFrame message;
    message.id = static_cast<std::uint16_t>(frame.can_id & CAN_SFF_MASK);
    std::copy(frame.data, frame.data + 8, message.data.begin());
    const Bytes packet = makeRmpBasePacket(message);
    if (packet.size() > size) return result;
    std::copy(packet.begin(), packet.end(), buffer);
    result.size = packet.size();
    return result;
  }
  bool write(ByteView bytes) override {
    for (std::size_t at = 0; at + kRmpPacketSize <= bytes.size; at += kRmpPacketSize) {
      can_frame frame{};
      frame.can_id = bigWord(bytes.data + at + 6);
      frame.can_dlc = 8;
      std::copy(bytes.data + at + 9, bytes.data + at + 17, frame.data);
      if (!DescriptorPort::write({reinterpret_cast<const std::uint8_t*>(&frame), sizeof(frame)})) return false;
    }
    return true;
  }
};

int failCan(int descriptor, std::string& error) {
  error = std::strerror(errno);
  if (descriptor >= 0) ::close(descriptor);
  return -1;
}

int openCanSocket(const std::string& interface, std::string& error) {
  const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor < 0) return failCan(descriptor, error);
  ifreq request{};
  std::strncpy(request.ifr_name, interface.c_str(), IFNAMSIZ - 1);
  if (::ioctl(descriptor, SIOCGIFINDEX, &request) < 0) return failCan(descriptor, error);
  const std::array<can_filter, 2> filters = {can_filter{0x400, 0x7F8}, can_filter{0x680, CAN_SFF_MASK}};
  ::setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), sizeof(filters));
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = request.ifr_ifindex;
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) < 0)
    return failCan(descriptor, error);
  return descriptor;
}

}  // namespace

std::unique_ptr<Port> openCanPort(const std::string& interface, std::string& error) {
  const int descriptor = openCanSocket(interface, error);
  return descriptor < 0 ? nullptr : std::make_unique<CanPort>(descriptor);
}

}  // namespace segway_drivers

#else

namespace segway_drivers {

std::unique_ptr<Port> openCanPort(const std::string& /*interface*/, std::string& error) {
  error = "built without SocketCAN";
  return nullptr;
}

}  // namespace segway_drivers

#endif
