// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace rosbag {
class Bag;
}

namespace urban_nav_input {

/// Writes serialized messages to a ROS 1 bag whose chunks are not compressed. The bag appears when it is complete
/// (until then it is PATH.active, as for rosbag record). Throws UserError naming the bag if it cannot be written.
/// Not thread-safe.
class BagFileWriter {
 public:
  explicit BagFileWriter(const std::string& path);
  ~BagFileWriter();

  /// Appends a message of a connection that is encoded as ROS 1, with its type, definition and MD5 sum.
  void write(const Connection& connection, urban_nav_core::StampNs receipt, ByteView message);
  /// Returns the size of the file so far, bytes.
  std::uint64_t size() const;
  void commit();

 private:
  [[noreturn]] void fail(const std::exception& error) const;

  /// Does not destroy a bag that cannot be closed (full disk), since its destructor would end the process.
  struct Close {
    void operator()(rosbag::Bag* bag) const;
  };

  std::string path_;
  urban_nav_core::PartialFile file_;
  std::unique_ptr<rosbag::Bag, Close> bag_;
};

}  // namespace urban_nav_input
