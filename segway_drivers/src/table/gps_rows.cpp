// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/stream.hpp"
#include "table/rows.hpp"

namespace segway_drivers {

namespace {

class GpsRows : public RowDecoder {
 public:
  GpsRows(const GpsStream::Options& options, Sink sink) : stream_(options), sink_(std::move(sink)) {
    stream_.on_fix = [this](const GpsFix& fix, std::optional<TimeNs> stamp) {
      sink_({fix.offset, stamp, gpsCells(fix)});
    };
  }
  void feed(ByteView chunk, const ChunkArrival& arrival) override { stream_.feed(chunk, arrival); }
  void finish() override { stream_.finish(); }
  DeviceCounters counters() const override { return stream_.counters(); }

 private:
  GpsStream stream_;
  Sink sink_;
};

}  // namespace

std::string gpsCells(const GpsFix& fix) {
  std::string cells = fix.utc + "," + std::to_string(static_cast<int>(fix.mode));
  const std::optional<double> values[] = {fix.latitude, fix.longitude, fix.height, fix.sigma_e, fix.sigma_n,
                                          fix.sigma_u,  fix.speed,     fix.track,  fix.climb};
  for (const std::optional<double>& value : values) {
    cells += ',';
    std::string cell;
    if (value) appendCell(cell, *value);
    cells += cell;
  }
  cells += "," + (fix.satellites ? std::to_string(*fix.satellites) : std::string()) + "," + fix.source;
  return cells;
}

std::unique_ptr<RowDecoder> makeGpsRows(const Parameters& parameters, RowDecoder::Sink sink) {
  GpsStream::Options options;
  options.uere = parameters.gps_uere;
  options.latency = 1e-3 * parameters.gps_latency_ms;
  return std::make_unique<GpsRows>(options, std::move(sink));
}

}  // namespace segway_drivers
