// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <utility>

#include "recording/storage/packed_message.hpp"
#include "recording/storage/recognise.hpp"
#include "recording/storage/rosbag2_metadata.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

/// Folder of rosbag2: the files listed in metadata.yaml; without it, the only recording in the folder.
class Rosbag2Folder : public Storage {
 public:
  explicit Rosbag2Folder(const std::string& path) {
    const fs::path folder(path), about = folder / "metadata.yaml";
    Rosbag2Metadata metadata;
    if (fs::exists(about)) {
      metadata = readRosbag2Metadata(about.string());
      if (!metadata.compression.empty() && metadata.compression != "zstd")
        throw UserError(about.string(), "names the compression " + metadata.compression + ", which is not supported",
                        "zstd");
      openNamed(folder, metadata);
    } else {
      openOnly(folder);
    }
    for (std::size_t file = 0; file < files_.size(); ++file)
      for (std::size_t i = 0; i < files_[file]->connections().size(); ++i) {
        Connection connection = files_[file]->connections()[i];
        const auto encoding = metadata.encodings.find(connection.topic);
        if (encoding != metadata.encodings.end() && !encoding->second.empty()) connection.encoding = encoding->second;
        connections_.push_back(std::move(connection));
        places_.push_back({file, i});
      }
  }

  const char* kind() const override { return "rosbag2"; }
  std::string description() const override { return "a folder of rosbag2"; }
  const std::vector<Connection>& connections() const override { return connections_; }

  const std::vector<MessageEntry>& index(std::size_t connection) override {
    const Place& place = places_[connection];
    return files_[place.file]->index(place.connection);
  }

  ByteView read(std::size_t connection, const MessageEntry& entry) override {
    const Place& place = places_[connection];
    const ByteView bytes = files_[place.file]->read(place.connection, entry);
    if (bytes.data == nullptr) return bytes;
    const ByteView message = unpack_(bytes);
    if (message.data == nullptr) ++damaged_;
    return message;
  }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> all = warnings_;
    for (std::size_t i = 0; i < files_.size(); ++i)
      for (const std::string& warning : files_[i]->warnings()) all.push_back(names_[i] + " " + warning);
    if (damaged_ > 0) all.push_back(std::to_string(damaged_) + " messages cannot be decompressed and are left out");
    return all;
  }

 private:
  struct Place {
    std::size_t file, connection;
  };

  void openNamed(const fs::path& folder, const Rosbag2Metadata& metadata) {
    std::string missing;
    for (const std::string& name : metadata.files) {
      fs::path path = folder / name;
      if (!fs::exists(path)) path = folder / fs::path(name).filename();  // as written by Eloquent
      if (!fs::exists(path)) {
        missing += (missing.empty() ? "" : ", ") + name;
        continue;
      }
      try {
        files_.push_back(openStorage(path.string()));
        names_.push_back(name);
      } catch (const urban_nav_core::Error& error) {
        warnings_.push_back(name + " is left out: " + error.parts().found);
        if (warnings_.size() == metadata.files.size()) throw;  // none can be read
      }
    }
    const std::string about = (folder / "metadata.yaml").string();
    if (metadata.files.empty()) throw UserError(about, "names no files (relative_file_paths)", "");
    if (files_.empty()) throw DataError(about, "names missing files: " + missing, "");
    if (!missing.empty()) warnings_.push_back("metadata.yaml names missing files: " + missing);
  }

  void openOnly(const fs::path& folder) {
    const std::vector<std::string> found = listRosbag2Files(folder.string());
    if (found.size() != 1)
      throw UserError(folder.string(), "holds " + std::to_string(found.size()) + " recordings and no metadata.yaml",
                      "the recording itself: " + (found.empty() ? "" : found.front() + " or " + found.back()));
    names_.push_back(fs::path(found.front()).filename().string());
    files_.push_back(openStorage(found.front()));
  }

  std::vector<std::string> names_;
  std::vector<std::unique_ptr<Storage>> files_;
  std::vector<Connection> connections_;
  std::vector<Place> places_;  // index: connection
  MessageUnpacker unpack_;
  std::vector<std::string> warnings_;
  std::uint64_t damaged_ = 0;
};

}  // namespace

std::unique_ptr<Storage> openRosbag2Folder(const std::string& path) { return std::make_unique<Rosbag2Folder>(path); }

}  // namespace urban_nav_input
