// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/lidar_stream.hpp"
#include "urban_nav_input/folder/kitti_sweeps.hpp"

namespace urban_nav_input {

/// The sweeps of a KITTI folder in the order of their stamps. Not thread-safe.
class KittiSweepStream {
 public:
  /// `T_base_camera`: of the rectified left camera. Throws UserError for invalid stamps or calibration, or for
  /// times of points that such a folder does not have.
  KittiSweepStream(const KittiSweepLayout& layout, const urban_nav_core::Pose& T_base_camera,
                   const SourceOptions& options);

  std::size_t size() const { return files_.size(); }
  urban_nav_core::StampNs first() const { return files_.front().first; }
  urban_nav_core::StampNs last() const { return files_.back().first; }
  /// Returns whether the mounting of the LiDAR is known.
  bool isPlaced() const { return stream_.has_value(); }
  /// Returns the stamp of the next sweep; nullopt at the end.
  std::optional<urban_nav_core::StampNs> nextStamp() const;
  /// Reads the next sweep; nullopt, and counted, if it has no usable points.
  std::optional<SweepInput> next();

  /// Returns the stream with its convention. Requires isPlaced().
  InputStream describe() const { return stream_->describe(); }
  const std::vector<std::string>& notes() const { return notes_; }
  std::vector<Finding> findings() const { return stream_ ? stream_->findings() : std::vector<Finding>(); }

 private:
  void survey();

  std::vector<std::string> notes_;
  std::vector<std::pair<urban_nav_core::StampNs, std::string>> files_;
  std::optional<LidarStream> stream_;
  std::size_t position_ = 0;
};

}  // namespace urban_nav_input
