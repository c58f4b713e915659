// SPDX-License-Identifier: BSD-3-Clause
// Processor time to read all messages of recordings, best of five:
//   read_recordings RECORDING...
// As references, a ROS 1 bag is also read by librosbag alone, and the chunks of an MCAP file are also only
// decompressed.
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "recording/storage/inflate.hpp"
#include "recording/storage/mapped_file.hpp"
#include "recording/storage/mcap_records.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input::bench {

constexpr int kRuns = 5;

double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Prints the shortest of several runs of `read`, which returns the number of bytes.
void measure(const std::string& name, const std::function<std::size_t()>& read) {
  double best = std::numeric_limits<double>::infinity();
  std::size_t bytes = 0;
  for (int run = 0; run < kRuns; ++run) {
    const double begin = processorSeconds();
    bytes = read();
    best = std::min(best, processorSeconds() - begin);
  }
  std::printf("%-60s %8.1f MB %8.3f s\n", name.c_str(), 1e-6 * static_cast<double>(bytes), best);
}

std::size_t readByLibrosbag(const std::string& path) {
  rosbag::Bag bag(path);
  std::vector<std::uint8_t> buffer;
  std::size_t bytes = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    buffer.resize(std::max<std::size_t>(buffer.size(), message.size()));
    ros::serialization::OStream stream(buffer.data(), message.size());
    message.write(stream);
    bytes += message.size();
  }
  return bytes;
}

std::size_t readAll(const std::string& path) {
  Recording recording(path);
  std::size_t bytes = 0;
  MessageSelection messages = recording.select(std::nullopt);
  while (const std::optional<RecordedMessage> message = messages.next()) bytes += message->bytes().size;
  return bytes;
}

std::size_t inflateChunks(const std::string& path) {
  const MappedFile file(path);
  std::size_t bytes = 0;
  mcap::RecordWalk walk(file.bytes(), mcap::kMagic.size());
  while (const std::optional<mcap::Record> record = walk.next()) {
    const std::optional<mcap::Chunk> chunk =
        record->op == mcap::Op::Chunk ? mcap::parseChunk(record->content) : std::nullopt;
    if (chunk && !chunk->compression.empty())
      bytes += inflate(chunk->compression, chunk->packed, static_cast<std::size_t>(chunk->size)).size;
  }
  return bytes;
}

}  // namespace urban_nav_input::bench

int main(int argc, char** argv) {
  namespace bench = urban_nav_input::bench;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string path = argv[i];
      const std::string kind = urban_nav_input::Recording(path).kind();
      bench::measure(path, [&] { return bench::readAll(path); });
      if (kind == "bag") bench::measure("  by librosbag", [&] { return bench::readByLibrosbag(path); });
      if (kind == "mcap") bench::measure("  decompression alone", [&] { return bench::inflateChunks(path); });
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
