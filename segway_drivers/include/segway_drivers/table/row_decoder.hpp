// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "segway_drivers/parameters.hpp"
#include "segway_drivers/stream/counters.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// One message of a device as text.
struct DeviceRow {
  std::uint64_t offset = 0;  ///< of its first byte in the stream
  std::optional<TimeNs> stamp;
  std::string cells;  ///< separated by commas; empty for unknown values
};

/// Converts bytes of a recorded stream to rows of text, for chunks of any size. Not thread-safe.
class RowDecoder {
 public:
  using Sink = std::function<void(const DeviceRow& row)>;
  virtual ~RowDecoder() = default;
  virtual void feed(ByteView chunk, const ChunkArrival& arrival) = 0;
  virtual void finish() = 0;
  virtual DeviceCounters counters() const = 0;
};

/// Output folder of images of camera decoders.
struct ImageFolder {
  std::string folder;  ///< existing folder
  std::string stem;    ///< files are named STEM_FRAME_NAME.png
};

/// Returns the names of the kinds of devices in the order of documentation.
const std::vector<std::string>& deviceKinds();
/// Returns the column names of a kind, separated by commas.
std::string rowColumns(const std::string& kind);
/// Throws UserError for an unknown kind.
std::unique_ptr<RowDecoder> makeRowDecoder(const std::string& kind, const Parameters& parameters,
                                           const ImageFolder& images, RowDecoder::Sink sink);

}  // namespace segway_drivers
