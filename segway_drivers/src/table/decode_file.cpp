// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/decode_file.hpp"

#include <algorithm>
#include <filesystem>
#include <random>
#include <vector>

#include "segway_drivers/gps/unknown_stream.hpp"
#include "segway_drivers/table/row_decoder.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

namespace {

constexpr std::size_t kLongestRandomChunk = 2000;

/// One read of the recorded transport; its bytes end at the start of the next one.
struct RecordedRead {
  std::size_t begin = 0;
  TimeNs time = 0;
};

std::vector<RecordedRead> readArrivals(const std::string& path) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(path);
  const std::size_t offset = table.column("offset"), arrival = table.column("arrival_ns");
  std::vector<RecordedRead> reads;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::int64_t begin = table.integer(row, offset), time = table.integer(row, arrival);
    if (begin < 0 || time <= 0 || (!reads.empty() && static_cast<std::size_t>(begin) <= reads.back().begin))
      throw urban_nav_core::UserError(table.where(row), "offset or arrival out of order",
                                      "increasing offsets from 0, positive times");
    reads.push_back({static_cast<std::size_t>(begin), time});
  }
  return reads;
}

/// Passes the bytes of one read to the decoder in chunks.
void feedRead(RowDecoder& decoder, ByteView bytes, TimeNs time, int chunk, std::mt19937_64& random) {
  std::size_t at = 0;
  while (at < bytes.size) {
    const std::size_t wanted = chunk > 0 ? static_cast<std::size_t>(chunk) : 1 + random() % kLongestRandomChunk;
    const std::size_t size = std::min(wanted, bytes.size - at);
    decoder.feed(bytes.sub(at, size), {time, bytes.size - at - size});
    at += size;
  }
}

}  // namespace

DeviceCounters decodeFile(const DecodeJob& job, const Parameters& parameters) {
  rowColumns(job.kind);  // rejects an unknown kind before any file is read
  const std::string text = urban_nav_core::readBytes(job.input);
  const ByteView bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  std::vector<RecordedRead> reads;
  if (!job.arrivals.empty()) reads = readArrivals(job.arrivals);
  if (reads.empty() || reads.front().begin > 0) reads.insert(reads.begin(), {0, 0});

  const std::filesystem::path output(job.output);
  urban_nav_core::AtomicFile file(job.output);
  file.write("frame,offset,stamp_ns," + rowColumns(job.kind) + "\n");
  std::int64_t frame = 0;
  const auto decoder = makeRowDecoder(
      job.kind, parameters, {output.parent_path().string(), output.stem().string()}, [&](const DeviceRow& row) {
        file.write(std::to_string(frame++) + "," + std::to_string(row.offset) + "," +
                   (row.stamp ? std::to_string(*row.stamp) : std::string()) + "," + row.cells + "\n");
      });
  std::mt19937_64 random(job.seed);
  for (std::size_t i = 0; i < reads.size() && reads[i].begin < bytes.size; ++i) {
    const std::size_t end = i + 1 < reads.size() ? std::min(reads[i + 1].begin, bytes.size) : bytes.size;
    feedRead(*decoder, bytes.sub(reads[i].begin, end - reads[i].begin), reads[i].time, job.chunk, random);
  }
  decoder->finish();
  if (job.kind == "gps" && decoder->counters().frames == 0)
    throw urban_nav_core::DataError(
        job.input, "holds no whole frame of a receiver, and is probably " + describeUnknownStream(bytes),
        "NMEA, u-blox' or Garmin's binary, JSON lines of gpsd");
  file.commit();
  return decoder->counters();
}

}  // namespace segway_drivers
