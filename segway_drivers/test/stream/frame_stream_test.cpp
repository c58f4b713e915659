// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/stream/frame_stream.hpp"

#include <gtest/gtest.h>

#include <random>

namespace segway_drivers {
namespace {

/// Frames of a toy protocol: A5, length of the body (at most 20), body, sum of the body.
FrameProbe probeToy(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != 0xA5) return {Kind::NoFrame, 0};
  if (bytes.size < 2) return {Kind::Incomplete, 0};
  const std::size_t length = bytes[1], size = length + 3;
  if (length > 20) return {Kind::NoFrame, 0};
  if (bytes.size < size) return {Kind::Incomplete, size};
  unsigned sum = 0;
  for (std::size_t i = 0; i < length; ++i) sum += bytes[2 + i];
  return {(sum & 0xFFU) == bytes[size - 1] ? Kind::Frame : Kind::BadChecksum, size};
}

Bytes makeToy(const Bytes& body) {
  Bytes frame = {0xA5, static_cast<std::uint8_t>(body.size())};
  unsigned sum = 0;
  for (const std::uint8_t byte : body) {
    frame.push_back(byte);
    sum += byte;
  }
  frame.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  return frame;
}

std::vector<std::uint64_t> findOffsets(const Bytes& bytes, std::size_t chunk, DeviceCounters* counters = nullptr) {
  FrameStream stream(23, probeToy);
  std::vector<std::uint64_t> offsets;
  const auto sink = [&](const StreamFrame& frame) { offsets.push_back(frame.offset); };
  for (std::size_t at = 0; at < bytes.size(); at += chunk)
    stream.feed(ByteView(bytes).sub(at, std::min(chunk, bytes.size() - at)), {}, sink);
  stream.finish(sink);
  if (counters != nullptr) *counters = stream.counters();
  return offsets;
}

TEST(FrameStream, FramesAreTheSameForChunksOfAnySize) {
  std::mt19937 random(1);
  Bytes bytes;
  for (int i = 0; i < 200; ++i) {
    Bytes body(random() % 21);
    for (std::uint8_t& byte : body) byte = random() % 3 == 0 ? 0xA5 : static_cast<std::uint8_t>(random());
    const Bytes frame = makeToy(body);
    const std::size_t kept = random() % 5 == 0 ? random() % frame.size() : frame.size();
    bytes.insert(bytes.end(), frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(kept));
    if (random() % 4 == 0) bytes.push_back(0xA5);
  }
  const auto whole = findOffsets(bytes, bytes.size());
  EXPECT_GT(whole.size(), 100U);
  for (const std::size_t chunk : {1U, 2U, 7U, 22U, 23U, 24U, 100U})
    EXPECT_EQ(findOffsets(bytes, chunk), whole) << chunk;
}

TEST(FrameStream, AFalseStartDoesNotSwallowTheFrameAfterIt) {
  const Bytes frame = makeToy({1, 2, 3});
  Bytes bytes = {0xA5, 20, 7};
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  DeviceCounters counters;
  EXPECT_EQ(findOffsets(bytes, 1, &counters), std::vector<std::uint64_t>{3});
  EXPECT_EQ(counters.bytes_skipped, 3);
  EXPECT_EQ(counters.frames, 1);
}

TEST(FrameStream, EveryByteIsPartOfAFrameOrSkipped) {
  std::mt19937 random(2);
  Bytes bytes(5000);
  std::int64_t of_frames = 0;
  for (std::uint8_t& byte : bytes) byte = random() % 4 == 0 ? 0xA5 : static_cast<std::uint8_t>(random() % 8);
  FrameStream stream(23, probeToy);
  const auto sink = [&](const StreamFrame& found) { of_frames += static_cast<std::int64_t>(found.bytes.size); };
  stream.feed(bytes, {}, sink);
  stream.finish(sink);
  EXPECT_EQ(stream.counters().bytes, 5000);
  EXPECT_EQ(stream.counters().bytes_skipped + of_frames, 5000);
}

TEST(FrameStream, AnExpiredFalseStartReleasesTheFrameAfterIt) {
  const Bytes frame = makeToy({1, 2, 3});
  Bytes bytes = {0xA5, 20, 7};
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  FrameStream stream(23, probeToy);
  stream.setBaud(9600);
  int found = 0;
  const auto sink = [&](const StreamFrame&) { ++found; };
  stream.feed(bytes, {1'000'000'000, 0}, sink);
  stream.expire(1'010'000'000, sink);
  EXPECT_EQ(found, 0);
  stream.expire(1'200'000'000, sink);
  EXPECT_EQ(found, 1);
  EXPECT_EQ(stream.counters().timeouts, 1);
}

/// Bytes leave at 1 ms each from time 1 s on; the arrival of a frame is that of its first byte, whatever the reads.
TEST(FrameStream, TheArrivalIsThatOfTheFirstByte) {
  const Bytes frame = makeToy({1, 2, 3, 4, 5});
  Bytes bytes = makeToy({9});
  const std::size_t first = bytes.size();
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  const auto toArrival = [](std::size_t byte) { return 1'000'000'000 + static_cast<TimeNs>(byte + 1) * 1'000'000; };
  for (const std::size_t chunk : {1U, 3U, 5U, 12U}) {
    FrameStream stream(23, probeToy);
    stream.setBaud(10000);
    TimeNs arrival = 0;
    for (std::size_t at = 0; at < bytes.size(); at += chunk) {
      const std::size_t size = std::min(chunk, bytes.size() - at);
      stream.feed(ByteView(bytes).sub(at, size), {toArrival(at + size - 1), 0},
                  [&](const StreamFrame& found) { arrival = found.arrival; });
    }
    EXPECT_EQ(arrival, toArrival(first) - 1'000'000) << chunk;
  }
}

TEST(FrameStream, APauseBeforeAFrameIsNotPartOfItsTransfer) {
  const Bytes frame = makeToy({1, 2, 3});
  FrameStream stream(23, probeToy);
  stream.setBaud(10000);
  std::vector<TimeNs> arrivals;
  const auto sink = [&](const StreamFrame& found) { arrivals.push_back(found.arrival); };
  stream.feed(frame, {1'006'000'000, 0}, sink);
  for (std::size_t i = 0; i < frame.size(); ++i)
    stream.feed(ByteView(frame).sub(i, 1), {2'001'000'000 + static_cast<TimeNs>(i) * 1'000'000, 0}, sink);
  EXPECT_EQ(arrivals, (std::vector<TimeNs>{1'000'000'000, 2'000'000'000}));
}

}  // namespace
}  // namespace segway_drivers
