// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/counters.hpp"

namespace segway_drivers {

/// Result of a framing rule for the bytes at the head of a stream.
struct FrameProbe {
  enum class Kind {
    NoFrame,      ///< no frame begins here
    Incomplete,   ///< a frame may begin here; `size` is its length if known, otherwise 0
    Frame,        ///< a frame of `size` bytes with a correct checksum
    BadChecksum,  ///< a frame of `size` bytes with a wrong checksum
  };
  Kind kind = Kind::NoFrame;
  std::size_t size = 0;
};

/// Arrival of a chunk: time of its read, and number of bytes that followed it in the same read.
struct ChunkArrival {
  TimeNs time = 0;  ///< ns; 0: unknown
  std::size_t following = 0;
};

/// One frame found in a stream. `bytes` is valid during the callback.
struct StreamFrame {
  ByteView bytes;
  std::uint64_t offset = 0;  ///< of the first byte in the stream
  TimeNs arrival = 0;        ///< earliest possible arrival of the first byte, ns; 0: unknown
};

/// Splits a byte stream into frames, for chunks of any size. Owns one buffer of fixed size; never blocks, throws,
/// allocates after construction, or reads a clock. After a wrong checksum or an impossible length the search resumes at
/// the next byte, so that a false start does not hide the following frame. The frames depend only on the bytes unless
/// expire() is called. Not thread-safe.
class FrameStream {
 public:
  /// Rule for the bytes at the head: `bytes` are all that have arrived, at least one. Must not return Incomplete for
  /// `max_frame` bytes.
  using Rule = std::function<FrameProbe(ByteView bytes)>;
  using Sink = std::function<void(const StreamFrame& frame)>;

  /// `max_frame`: largest frame, bytes.
  FrameStream(std::size_t max_frame, Rule rule);

  /// Sets the line rate, bit/s, 10 bits per byte, for arrival times; 0: bytes take no time.
  void setBaud(double baud);
  /// Adds a chunk and calls `sink` for each completed frame.
  void feed(ByteView chunk, const ChunkArrival& arrival, const Sink& sink);
  /// Discards a frame that has been incomplete for longer than twice its transfer time plus 50 ms, and searches from
  /// its second byte.
  void expire(TimeNs now, const Sink& sink);
  /// Searches the remaining bytes at the end of the stream; an incomplete frame is no frame.
  void finish(const Sink& sink);
  /// Discards buffered bytes, as after a change of the line rate. They count as skipped.
  void clear();

  const DeviceCounters& counters() const { return counters_; }

 private:
  struct Read {
    std::uint64_t begin = 0, end = 0;  // stream offsets of the chunk
    std::uint64_t read_end = 0;        // stream offset of the end of the read of the chunk
    TimeNs time = 0;                   // arrival of the byte before `read_end`
  };

  void append(ByteView chunk);
  void note(const Read& read);
  void search(const Sink& sink, bool at_end);
  void skip(std::size_t count);
  TimeNs firstByteArrival(std::size_t size) const;

  Rule rule_;
  std::size_t max_frame_;
  double byte_ns_ = 0.0;
  Bytes buffer_;
  std::size_t head_ = 0, tail_ = 0;  // in buffer_
  std::uint64_t offset_ = 0;         // of head_ in the stream
  std::array<Read, 64> reads_{};
  std::size_t read_count_ = 0;
  TimeNs head_since_ = 0;     // arrival of the byte at head_, for expire()
  std::size_t expected_ = 0;  // length of the incomplete frame at head_, if known
  DeviceCounters counters_;
};

}  // namespace segway_drivers
