// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "recording/storage/bag_records.hpp"
#include "recording/storage/bag_scan.hpp"
#include "recording/storage/mapped_file.hpp"
#include "recording/storage/mcap_chunk_cache.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

/// ROS 1 bag whose index is missing or damaged.
class ScannedBagStorage : public Storage {
 public:
  explicit ScannedBagStorage(const std::string& path)
      : file_(path), scan_(scanBag(path, file_.bytes())), cache_(scan_.chunks) {
    for (std::vector<MessageEntry>& entries : scan_.entries)
      if (!std::is_sorted(entries.begin(), entries.end())) std::sort(entries.begin(), entries.end());
    if (scan_.messages == 0)
      throw urban_nav_core::DataError(path, scan_.warnings.empty() ? "holds no whole message" : scan_.warnings.front(),
                                      "a bag with messages");
  }

  const char* kind() const override { return "bag"; }
  const std::vector<Connection>& connections() const override { return scan_.connections; }
  const std::vector<MessageEntry>& index(std::size_t connection) override { return scan_.entries[connection]; }

  ByteView read(std::size_t connection, const MessageEntry& entry) override {
    const std::uint64_t chunk = placedChunk(entry.place);
    const ByteView records = chunk == kNoChunk ? file_.bytes() : cache_.records(static_cast<std::size_t>(chunk));
    if (records.data == nullptr) return {};
    const std::optional<rosbag1::Record> record = rosbag1::RecordWalk(records, placedOffset(entry.place)).next();
    const bool is_meant = record && record->op == rosbag1::Op::Message &&
                          rosbag1::findNumber<std::uint32_t>(record->header, "conn") == scan_.ids[connection];
    return is_meant ? record->data : ByteView{};
  }

  std::uint64_t chunksInflated() const override { return cache_.inflated(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> all = scan_.warnings;
    all.insert(all.end(), cache_.warnings().begin(), cache_.warnings().end());
    return all;
  }

 private:
  MappedFile file_;
  BagScan scan_;
  McapChunkCache cache_;
};

}  // namespace

std::unique_ptr<Storage> openScannedBag(const std::string& path) { return std::make_unique<ScannedBagStorage>(path); }

}  // namespace urban_nav_input
