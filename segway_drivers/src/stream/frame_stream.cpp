// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/stream/frame_stream.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace segway_drivers {

namespace {

constexpr TimeNs kExpirySlack = 50'000'000;  // ns: scheduling delay of a busy host

}  // namespace

FrameStream::FrameStream(std::size_t max_frame, Rule rule)
    : rule_(std::move(rule)), max_frame_(max_frame), buffer_(2 * max_frame + 1) {}

void FrameStream::setBaud(double baud) { byte_ns_ = baud > 0.0 ? 1e10 / baud : 0.0; }

void FrameStream::feed(ByteView chunk, const ChunkArrival& arrival, const Sink& sink) {
  while (chunk.size > 0) {
    const std::size_t count = std::min(chunk.size, buffer_.size() - (tail_ - head_));
    const std::uint64_t begin = offset_ + (tail_ - head_);
    if (head_ == tail_) head_since_ = arrival.time;
    append(chunk.sub(0, count));
    note({begin, begin + count, begin + chunk.size + arrival.following, arrival.time});
    search(sink, false);
    if (head_ != tail_ && arrival.time != 0 && offset_ >= begin) head_since_ = arrival.time;
    chunk = chunk.sub(count, chunk.size - count);
  }
}

void FrameStream::append(ByteView chunk) {
  if (tail_ + chunk.size > buffer_.size()) {
    std::memmove(buffer_.data(), buffer_.data() + head_, tail_ - head_);
    tail_ -= head_;
    head_ = 0;
  }
  std::memcpy(buffer_.data() + tail_, chunk.data, chunk.size);
  tail_ += chunk.size;
  counters_.bytes += static_cast<std::int64_t>(chunk.size);
}

/// Records the arrival of bytes. If the record is full every other entry is dropped; the remaining ones still bound the
/// arrival from above.
void FrameStream::note(const Read& read) {
  if (read_count_ > 0) {
    Read& last = reads_[read_count_ - 1];
    if (last.time == read.time && last.read_end == read.read_end) {
      last.end = read.end;
      return;
    }
  }
  if (read_count_ == reads_.size()) {
    for (std::size_t i = 0; i < read_count_ / 2; ++i) {
      reads_[i].begin = reads_[2 * i].begin;
      reads_[i].end = reads_[2 * i + 1].end;
      reads_[i].read_end = reads_[2 * i + 1].read_end;
      reads_[i].time = reads_[2 * i + 1].time;
    }
    read_count_ /= 2;
  }
  reads_[read_count_++] = read;
}

TimeNs FrameStream::firstByteArrival(std::size_t size) const {
  TimeNs earliest = 0;
  for (std::size_t i = 0; i < read_count_; ++i) {
    const Read& read = reads_[i];
    if (read.end <= offset_ || read.begin >= offset_ + size || read.time == 0) continue;
    const double transfer = byte_ns_ * static_cast<double>(read.read_end - offset_);
    const TimeNs bound = read.time - static_cast<TimeNs>(std::llround(transfer));
    if (earliest == 0 || bound < earliest) earliest = bound;
  }
  return earliest;
}

void FrameStream::skip(std::size_t count) {
  head_ += count;
  offset_ += count;
  if (head_ == tail_) head_ = tail_ = 0;
  std::size_t gone = 0;
  while (gone < read_count_ && reads_[gone].end <= offset_) ++gone;
  if (gone > 0) {
    std::move(reads_.begin() + static_cast<std::ptrdiff_t>(gone),
              reads_.begin() + static_cast<std::ptrdiff_t>(read_count_), reads_.begin());
    read_count_ -= gone;
  }
}

void FrameStream::search(const Sink& sink, bool at_end) {
  expected_ = 0;
  std::size_t skipped = 0;
  while (head_ + skipped < tail_) {
    const ByteView rest(buffer_.data() + head_ + skipped, tail_ - head_ - skipped);
    const FrameProbe probe = rule_(rest);
    assert(probe.kind != FrameProbe::Kind::Incomplete || rest.size < max_frame_);
    if (probe.kind == FrameProbe::Kind::Incomplete && !at_end) {
      expected_ = probe.size;
      break;
    }
    if (probe.kind != FrameProbe::Kind::Frame) {
      if (probe.kind == FrameProbe::Kind::BadChecksum) ++counters_.bad_checksums;
      ++counters_.bytes_skipped;
      ++skipped;
      continue;
    }
    skip(skipped);
    skipped = 0;
    ++counters_.frames;
    sink({ByteView(buffer_.data() + head_, probe.size), offset_, firstByteArrival(probe.size)});
    skip(probe.size);
  }
  skip(skipped);
}

void FrameStream::expire(TimeNs now, const Sink& sink) {
  if (head_ == tail_ || head_since_ == 0) return;
  const std::size_t size = expected_ > 0 ? expected_ : max_frame_;
  if (now - head_since_ < static_cast<TimeNs>(2.0 * byte_ns_ * static_cast<double>(size)) + kExpirySlack) return;
  ++counters_.timeouts;
  ++counters_.bytes_skipped;
  skip(1);
  head_since_ = now;
  search(sink, false);
}

void FrameStream::finish(const Sink& sink) { search(sink, true); }

void FrameStream::clear() {
  counters_.bytes_skipped += static_cast<std::int64_t>(tail_ - head_);
  skip(tail_ - head_);
}

}  // namespace segway_drivers
