// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "segway_drivers/segway_rmp/stream.hpp"
#include "segway_drivers/segway_rmp/units.hpp"
#include "table/rows.hpp"

namespace segway_drivers {

namespace {

class RmpRows : public RowDecoder {
 public:
  RmpRows(double latency, Sink sink) : stream_(latency), sink_(std::move(sink)) {
    stream_.on_frame = [this](const RmpStampedFrame& frame) {
      sink_({frame.offset, frame.stamp, rmpCells(frame.frame)});
    };
  }
  void feed(ByteView chunk, const ChunkArrival& arrival) override { stream_.feed(chunk, arrival); }
  void finish() override { stream_.finish(); }
  DeviceCounters counters() const override { return stream_.counters(); }

 private:
  RmpStream stream_;
  Sink sink_;
};

/// Decodes lines of `candump -l`, whose times are the arrivals.
class CandumpRows : public RowDecoder {
 public:
  CandumpRows(double latency, Sink sink) : stream_(latency), sink_(std::move(sink)) {
    stream_.on_frame = [this](const RmpStampedFrame& frame) {
      sink_({frame.offset, frame.stamp, rmpCells(frame.frame)});
    };
  }
  void feed(ByteView chunk, const ChunkArrival&) override {
    for (const std::uint8_t byte : chunk) {
      ++bytes_;
      if (byte == '\n') takeLine();
      else if (line_.size() < kLongestLine) line_ += static_cast<char>(byte);
    }
  }
  void finish() override {
    if (!line_.empty()) takeLine();
  }
  DeviceCounters counters() const override {
    DeviceCounters counters = stream_.counters();
    counters.bytes = static_cast<std::int64_t>(bytes_);
    counters.bytes_skipped = skipped_;
    return counters;
  }

 private:
  static constexpr std::size_t kLongestLine = 200;

  void takeLine() {
    const auto line = parseCandumpLine(line_);
    if (line) stream_.add(line->frame, begin_, line->time);
    else skipped_ += static_cast<std::int64_t>(bytes_ - begin_);
    line_.clear();
    begin_ = bytes_;
  }

  RmpStream stream_;
  Sink sink_;
  std::string line_;
  std::uint64_t bytes_ = 0, begin_ = 0;
  std::int64_t skipped_ = 0;
};

}  // namespace

std::string rmpCells(const CanFrame& frame) {
  char id[8];
  std::snprintf(id, sizeof(id), "%04x", frame.id);
  std::string cells = id;
  const auto values = decodeRmpValues(frame);
  for (std::size_t i = 0; i < 4; ++i) {
    cells += ',';
    std::string cell;
    if (values && (*values)[i]) appendCell(cell, *(*values)[i]);
    cells += cell;
  }
  return cells;
}

std::unique_ptr<RowDecoder> makeRmpRows(const Parameters& parameters, RowDecoder::Sink sink) {
  return std::make_unique<RmpRows>(1e-3 * parameters.segway_rmp_latency_ms, std::move(sink));
}

std::unique_ptr<RowDecoder> makeCandumpRows(const Parameters& parameters, RowDecoder::Sink sink) {
  return std::make_unique<CandumpRows>(1e-3 * parameters.segway_rmp_latency_ms, std::move(sink));
}

}  // namespace segway_drivers
