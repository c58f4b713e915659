// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "recording/storage/bag_index.hpp"
#include "recording/storage/bag_records.hpp"
#include "recording/storage/bag_scan.hpp"
#include "recording/storage/mapped_file.hpp"
#include "recording/storage/mcap_chunk_cache.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

/// ROS 1 bag whose records are read by their positions, with or without its index. Does not use librosbag, which does
/// not check lengths and positions in a damaged file.
class BagRecordsStorage : public Storage {
 public:
  BagRecordsStorage(const std::string& path, bool by_index)
      : file_(path), scan_(read(path, by_index)), cache_(scan_.chunks) {
    for (std::vector<MessageEntry>& entries : scan_.entries)
      if (!std::is_sorted(entries.begin(), entries.end())) std::sort(entries.begin(), entries.end());
  }

  const char* kind() const override { return "bag"; }
  std::string description() const override { return "a ROS 1 bag"; }
  const std::vector<Connection>& connections() const override { return scan_.connections; }
  const std::vector<MessageEntry>& index(std::size_t connection) override { return scan_.entries[connection]; }

  ByteView read(std::size_t connection, const MessageEntry& entry) override {
    const std::uint64_t chunk = placedChunk(entry.place);
    const ByteView records = chunk == kNoChunk ? file_.bytes() : cache_.records(static_cast<std::size_t>(chunk));
    if (records.data == nullptr) {
      ++damaged_;
      return {};
    }
    const std::optional<rosbag1::Record> record = rosbag1::RecordWalk(records, placedOffset(entry.place)).next();
    const bool is_meant = record && record->op == rosbag1::Op::Message &&
                          rosbag1::findNumber<std::uint32_t>(record->header, "conn") == scan_.ids[connection];
    if (is_meant) {
      file_.countRead(record->data.size);
      return record->data;
    }
    ++misplaced_;
    return {};
  }

  std::uint64_t chunksInflated() const override { return cache_.inflated(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> all = scan_.warnings;
    if (damaged_ > 0)
      all.push_back(std::to_string(damaged_) + (damaged_ == 1 ? " message cannot" : " messages cannot") +
                    " be read and are left out: " + cache_.warnings().front());
    if (misplaced_ > 0)
      all.push_back("its index is wrong: " + std::to_string(misplaced_) +
                    (misplaced_ == 1 ? " message was not found" : " messages were not found"));
    return all;
  }

 private:
  BagScan read(const std::string& path, bool by_index) const {
    if (by_index)
      if (std::optional<BagScan> scan = readBagIndex(file_.bytes())) return std::move(*scan);
    BagScan scan = scanBag(path, file_.bytes());
    if (scan.messages == 0)
      throw urban_nav_core::DataError(path, scan.warnings.empty() ? "has no intact message" : scan.warnings.front(),
                                      "a bag with messages");
    return scan;
  }

  MappedFile file_;
  BagScan scan_;
  McapChunkCache cache_;
  std::uint64_t damaged_ = 0, misplaced_ = 0;  // messages that could not be read
};

}  // namespace

std::unique_ptr<Storage> openBagRecords(const std::string& path) {
  return std::make_unique<BagRecordsStorage>(path, true);
}
std::unique_ptr<Storage> openScannedBag(const std::string& path) {
  return std::make_unique<BagRecordsStorage>(path, false);
}

}  // namespace urban_nav_input
