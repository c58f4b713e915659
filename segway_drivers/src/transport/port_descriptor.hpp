// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

/// Port over a non-blocking file descriptor, which it owns.
class DescriptorPort : public Port {
 public:
  explicit DescriptorPort(int descriptor) : descriptor_(descriptor) {}
  ~DescriptorPort() override;
  DescriptorPort(const DescriptorPort&) = delete;
  DescriptorPort& operator=(const DescriptorPort&) = delete;

  ReadResult read(std::uint8_t* buffer, std::size_t size, TimeNs timeout) override;
  bool write(ByteView bytes) override;
  void setBaud(int /*baud*/) override {}

 protected:
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace segway_drivers
