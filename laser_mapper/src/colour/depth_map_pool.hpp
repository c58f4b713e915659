// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <vector>

#include "urban_nav_registration/visibility/depth_map.hpp"

namespace laser_mapper {

/// The depth maps of many views, of which only those in use are in memory: the others are in a temporary file without
/// a name, which disappears with this object. Not thread-safe.
class DepthMapPool {
 public:
  /// `budget`: bytes of depth maps in memory, which those of one hold() may exceed. `folder`: of the temporary file;
  /// empty, or not writable: the system's folder of temporary files.
  DepthMapPool(std::size_t budget, std::string folder);
  ~DepthMapPool();
  DepthMapPool(const DepthMapPool&) = delete;
  DepthMapPool& operator=(const DepthMapPool&) = delete;

  /// Adds the empty map of a camera. Its number is that of the maps added before.
  void add(const urban_nav_core::Pinhole& camera);

  enum class Access { Read, Write };
  /// Reads maps into memory until the next call. Throws DataError if the temporary file cannot be written or read.
  void hold(const std::vector<std::size_t>& maps, Access access);
  /// Returns a map that is held. Different maps may be used by different threads.
  urban_nav_registration::DepthMap& at(std::size_t map) { return entries_[map].depth; }

  std::size_t bytesInMemory() const { return in_memory_; }

 private:
  struct Entry {
    explicit Entry(const urban_nav_core::Pinhole& camera) : depth(camera) {}
    urban_nav_registration::DepthMap depth;
    std::size_t bytes = 0;
    long long offset = 0;       ///< in the file
    bool is_in_memory = false;  ///< otherwise in the file, or empty
    bool is_in_file = false;
    bool has_changed = false;  ///< since it was read
    std::size_t held = 0;      ///< number of the last hold()
    std::list<std::size_t>::iterator recent;
  };
  void load(Entry& entry);
  void evict(Entry& entry);
  void openFile();

  const std::size_t budget_;
  const std::string folder_;
  std::vector<Entry> entries_;
  std::list<std::size_t> recent_;  ///< maps in memory, most recently held first
  std::size_t in_memory_ = 0, holds_ = 0;
  long long end_ = 0;  ///< of the file
  int file_ = -1;
};

}  // namespace laser_mapper
