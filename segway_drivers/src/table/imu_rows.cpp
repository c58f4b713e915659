// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/xsens_mti/stream.hpp"
#include "table/rows.hpp"

namespace segway_drivers {

namespace {

template <std::size_t count>
void appendOptional(std::string& cells, const std::optional<std::array<double, count>>& values) {
  for (std::size_t i = 0; i < count; ++i) {
    cells += ',';
    std::string cell;
    if (values) appendCell(cell, (*values)[i]);
    cells += cell;
  }
}

void appendOptional(std::string& cells, std::optional<double> value) {
  cells += ',';
  std::string cell;
  if (value) appendCell(cell, *value);
  cells += cell;
}

class MtiRows : public RowDecoder {
 public:
  MtiRows(const MtiStream::Options& options, Sink sink) : stream_(options), sink_(std::move(sink)) {
    stream_.on_sample = [this](const MtiStampedSample& sample) {
      sink_({sample.offset, sample.stamp, mtiCells(sample.sample)});
    };
  }
  void feed(ByteView chunk, const ChunkArrival& arrival) override { stream_.feed(chunk, arrival); }
  void finish() override { stream_.finish(); }
  DeviceCounters counters() const override { return stream_.counters(); }

 private:
  MtiStream stream_;
  Sink sink_;
};

}  // namespace

std::string mtiCells(const MtiSample& sample) {
  std::string cells = sample.counter ? std::to_string(*sample.counter) : std::string();
  cells += "," + (sample.sample_time_fine ? std::to_string(*sample.sample_time_fine) : std::string());
  appendOptional(cells, sample.acceleration);
  appendOptional(cells, sample.rate);
  appendOptional(cells, sample.field);
  appendOptional(cells, sample.orientation);
  appendOptional(cells, sample.temperature);
  appendOptional(cells, sample.pressure);
  appendOptional(cells, sample.latitude);
  appendOptional(cells, sample.longitude);
  appendOptional(cells, sample.height);
  return cells;
}

std::unique_ptr<RowDecoder> makeMtiRows(const Parameters& parameters, RowDecoder::Sink sink) {
  MtiStream::Options options;
  options.mode = static_cast<unsigned>(parameters.xsens_mti_mode);
  options.settings = static_cast<unsigned>(parameters.xsens_mti_settings);
  options.period = 1.0 / parameters.xsens_mti_rate;
  options.latency = 1e-3 * parameters.xsens_mti_latency_ms;
  return std::make_unique<MtiRows>(options, std::move(sink));
}

}  // namespace segway_drivers
