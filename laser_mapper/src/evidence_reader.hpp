// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "laser_mapper/chunk_renderer.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace laser_mapper {

/// Reads the sweeps and depth images of the chunks of a session, with those of the seconds around them. Data common to
/// two chunks are read once if chunks are read in order of time. Not thread-safe.
class EvidenceReader {
 public:
  /// The store must outlive the reader.
  EvidenceReader(urban_nav_store::Store& store, urban_nav_store::SessionId session);

  /// Adds the sweeps, the images of depth cameras and, with Parameters::stereo, those of dense stereo of a chunk to
  /// `input`. Returns a digest of them; empty if there are none. Throws DataError if the store is damaged.
  std::string read(urban_nav_core::StampNs begin, const Parameters& parameters, ChunkInput& input);

 private:
  using SweepPtr = std::shared_ptr<const urban_nav_store::LidarSweep>;
  using ViewPtr = std::shared_ptr<const DepthFrame>;
  struct Lidar {
    urban_nav_store::MountedLidar mounted;
    std::map<urban_nav_core::StampNs, SweepPtr> sweeps;
    urban_nav_core::StampNs read_to = 0;
  };
  /// Identifies a depth image: its stamp, then its sensor as MapCell::laser.
  using ViewKey = std::pair<urban_nav_core::StampNs, std::uint8_t>;
  struct View {
    ViewPtr frame;
    std::string digest;
  };
  void advance(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const Parameters& parameters);
  void readViews(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const Parameters& parameters);

  urban_nav_store::Store& store_;
  const urban_nav_store::SessionId session_;
  std::vector<Lidar> lidars_;
  std::map<ViewKey, View> views_;
  urban_nav_core::StampNs views_read_to_ = 0;
};

}  // namespace laser_mapper
