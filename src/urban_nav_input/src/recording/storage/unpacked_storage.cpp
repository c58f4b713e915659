// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>

#include "recording/storage/storage.hpp"
#include "recording/storage/unpacked_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

/// Recording compressed as a file (compression_mode FILE of rosbag2).
class UnpackedStorage : public Storage {
 public:
  explicit UnpackedStorage(const std::string& path) : file_(path) {
    try {
      storage_ = openStorage(file_.path());
    } catch (const urban_nav_core::DataError& error) {
      throw urban_nav_core::DataError(path, error.parts().found, error.parts().allowed);
    }
  }

  const char* kind() const override { return storage_->kind(); }
  std::string description() const override { return storage_->description(); }
  const std::vector<Connection>& connections() const override { return storage_->connections(); }
  const std::vector<MessageEntry>& index(std::size_t connection) override { return storage_->index(connection); }
  ByteView read(std::size_t connection, const MessageEntry& entry) override {
    return storage_->read(connection, entry);
  }
  std::vector<std::string> warnings() const override {
    std::vector<std::string> all = storage_->warnings();
    if (!file_.isWhole()) all.push_back("its compression by zstd is cut off or damaged");
    return all;
  }

 private:
  UnpackedFile file_;
  std::unique_ptr<Storage> storage_;
};

}  // namespace

std::unique_ptr<Storage> openUnpackedStorage(const std::string& path) {
  return std::make_unique<UnpackedStorage>(path);
}

}  // namespace urban_nav_input
