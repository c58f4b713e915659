// SPDX-License-Identifier: BSD-3-Clause
#include "colour/depth_map_pool.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {

namespace {

/// Opens a file that has no name any more; -1 if the folder is not writable.
int openUnnamed(const std::string& folder) {
  std::string name = (std::filesystem::path(folder) / ".depth-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) unlink(name.c_str());
  return file;
}

urban_nav_core::DataError fileError(const char* what) {
  return {"temporary file of depth maps", std::string(what) + ": " + std::strerror(errno), ""};
}

}  // namespace

DepthMapPool::DepthMapPool(std::size_t budget, std::string folder) : budget_(budget), folder_(std::move(folder)) {}

DepthMapPool::~DepthMapPool() {
  if (file_ >= 0) close(file_);
}

void DepthMapPool::add(const urban_nav_core::Pinhole& camera) {
  Entry entry(camera);
  entry.bytes = entry.depth.size() * sizeof(float);
  entry.offset = end_;
  end_ += static_cast<long long>(entry.bytes);
  entries_.push_back(std::move(entry));
}

void DepthMapPool::openFile() {
  if (file_ >= 0) return;
  if (!folder_.empty()) file_ = openUnnamed(folder_);
  std::error_code ignored;
  if (file_ < 0) file_ = openUnnamed(std::filesystem::temp_directory_path(ignored).string());
  if (file_ < 0) throw fileError("cannot be created");
}

void DepthMapPool::load(Entry& entry) {
  std::vector<float> cells;
  if (entry.is_in_file) {
    cells.resize(entry.bytes / sizeof(float));
    std::size_t done = 0;
    while (done < entry.bytes) {
      const ssize_t read = pread(file_, reinterpret_cast<char*>(cells.data()) + done, entry.bytes - done,
                                 static_cast<off_t>(entry.offset) + static_cast<off_t>(done));
      if (read <= 0) throw fileError("cannot be read");
      done += static_cast<std::size_t>(read);
    }
  }
  entry.depth.setCells(std::move(cells));
  entry.is_in_memory = true;
  entry.has_changed = false;
  in_memory_ += entry.bytes;
}

void DepthMapPool::evict(Entry& entry) {
  const std::vector<float> cells = entry.depth.takeCells();
  if (entry.has_changed) {
    openFile();
    std::size_t done = 0;
    while (done < entry.bytes) {
      const ssize_t written = pwrite(file_, reinterpret_cast<const char*>(cells.data()) + done, entry.bytes - done,
                                     static_cast<off_t>(entry.offset) + static_cast<off_t>(done));
      if (written <= 0) throw fileError("cannot be written");
      done += static_cast<std::size_t>(written);
    }
    entry.is_in_file = true;
  }
  entry.is_in_memory = false;
  in_memory_ -= entry.bytes;
}

void DepthMapPool::hold(const std::vector<std::size_t>& maps, Access access) {
  ++holds_;
  for (const std::size_t map : maps) {
    Entry& entry = entries_[map];
    if (entry.is_in_memory) {
      recent_.splice(recent_.begin(), recent_, entry.recent);
    } else {
      load(entry);
      recent_.push_front(map);
    }
    entry.recent = recent_.begin();
    entry.held = holds_;
    entry.has_changed = entry.has_changed || access == Access::Write;
  }
  while (in_memory_ > budget_ && !recent_.empty() && entries_[recent_.back()].held != holds_) {
    evict(entries_[recent_.back()]);
    recent_.pop_back();
  }
}

}  // namespace laser_mapper
