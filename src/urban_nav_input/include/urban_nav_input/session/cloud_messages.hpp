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

/// Reads the clouds of a recording, whatever the type of their messages. Not thread-safe.
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

  /// Returns the cloud in a message; nullopt if it has none that can be read. A header without stamp gets the receipt.
  /// Throws DataError if the bytes of a PointCloud2 are damaged.
  std::optional<Cloud> read(const RecordedMessage& message);

 private:
  std::optional<Cloud> readLivox(const RecordedMessage& message);

  boost::shared_ptr<void> owner_;  // of the bytes of the last cloud
  std::vector<std::uint8_t> bytes_;
  std::map<std::string, std::unique_ptr<Transcoder>> transcoders_;  // by definition; null: it is ours
};

}  // namespace urban_nav_input
