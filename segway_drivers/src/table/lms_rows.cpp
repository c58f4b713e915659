// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/lms291/stream.hpp"
#include "table/rows.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace segway_drivers {

namespace {

class LmsRows : public RowDecoder {
 public:
  LmsRows(const LmsStream::Options& options, Sink sink) : stream_(options), sink_(std::move(sink)) {
    stream_.on_scan = [this](const LmsStampedScan& scan) { sink_({scan.offset, scan.stamp, lmsCells(scan.scan)}); };
  }
  void feed(ByteView chunk, const ChunkArrival& arrival) override { stream_.feed(chunk, arrival); }
  void finish() override { stream_.finish(); }
  DeviceCounters counters() const override { return stream_.counters(); }

 private:
  LmsStream stream_;
  Sink sink_;
};

}  // namespace

std::string lmsCells(const LmsScan& scan) {
  std::string ranges, reflectivities;
  for (const float range : scan.ranges) ranges += (ranges.empty() ? "" : " ") + urban_nav_core::printNumber(range);
  for (const std::uint8_t value : scan.reflectivities)
    reflectivities += (reflectivities.empty() ? "" : " ") + std::to_string(value);
  std::string cells = scan.index ? std::to_string(*scan.index) : std::string();
  cells += "," + std::to_string(scan.status) + "," + ranges + "," + reflectivities;
  return cells;
}

std::unique_ptr<RowDecoder> makeLmsRows(const Parameters& parameters, RowDecoder::Sink sink) {
  LmsStream::Options options;
  options.latency = 1e-3 * parameters.lms291_latency_ms;
  const auto format = LmsRangeFormat::fromConfiguration(static_cast<std::uint8_t>(parameters.lms291_measuring_mode), 1);
  if (format) options.format = *format;
  return std::make_unique<LmsRows>(options, std::move(sink));
}

}  // namespace segway_drivers
