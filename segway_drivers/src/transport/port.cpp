// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/transport/port.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <limits>

#include "transport/port_descriptor.hpp"

namespace segway_drivers {

namespace {

TimeNs readClock(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<TimeNs>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

TimeNs steadyTime() { return readClock(CLOCK_MONOTONIC); }

TimeNs realTimeOffset() {
  // Uses the pair of readings with the shortest interval.
  TimeNs best = 0, shortest = std::numeric_limits<TimeNs>::max();
  for (int i = 0; i < 3; ++i) {
    const TimeNs before = steadyTime(), real = readClock(CLOCK_REALTIME), after = steadyTime();
    if (after - before >= shortest) continue;
    shortest = after - before;
    best = real - before - shortest / 2;
  }
  return best;
}

DescriptorPort::~DescriptorPort() { ::close(descriptor_); }

Port::ReadResult DescriptorPort::read(std::uint8_t* buffer, std::size_t size, TimeNs timeout) {
  pollfd waiting{descriptor_, POLLIN, 0};
  const timespec limit{static_cast<time_t>(timeout / 1'000'000'000), static_cast<long>(timeout % 1'000'000'000)};
  const int ready = ::ppoll(&waiting, 1, &limit, nullptr);
  ReadResult result;
  if (ready <= 0) return result;
  const ssize_t count = ::read(descriptor_, buffer, size);
  result.time = steadyTime();
  if (count > 0) {
    result.outcome = Outcome::Data;
    result.size = static_cast<std::size_t>(count);
  } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
    result.outcome = Outcome::Gone;
  }
  return result;
}

bool DescriptorPort::write(ByteView bytes) {
  // A socket without reader must not end the process; other descriptors do not support send().
  ssize_t count = ::send(descriptor_, bytes.data, bytes.size, MSG_NOSIGNAL);
  if (count < 0 && errno == ENOTSOCK) count = ::write(descriptor_, bytes.data, bytes.size);
  return count == static_cast<ssize_t>(bytes.size);
}

}  // namespace segway_drivers
