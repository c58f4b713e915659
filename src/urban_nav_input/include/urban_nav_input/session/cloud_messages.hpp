// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_view.hpp"
#include "urban_nav_input/recording/recorded_message.hpp"

namespace urban_nav_input {

class Transcoder;

/// Reads the clouds of a recording from messages of any supported type. Not thread-safe.
class CloudMessages {
 public:
  struct Cloud {
    std::string frame;
    urban_nav_core::CloudView view;  ///< valid until the next call
  };
  CloudMessages();
  CloudMessages(CloudMessages&&) noexcept;
  CloudMessages& operator=(CloudMessages&&) noexcept;
  ~CloudMessages();

  /// Returns the cloud of a message; nullopt if unreadable. A header without stamp gets the time of receipt.
  /// Throws DataError if the bytes of a PointCloud2 are damaged.
  std::optional<Cloud> read(const RecordedMessage& message);

 private:
  std::optional<Cloud> readLivox(const RecordedMessage& message);

  boost::shared_ptr<void> owner_;  // of the bytes of the last cloud
  std::vector<std::uint8_t> bytes_;
  std::map<std::string, std::unique_ptr<Transcoder>> transcoders_;  // by definition; null: that of the suite
};

}  // namespace urban_nav_input
