// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"
#include "urban_nav_input/sensors/sweep_examination.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav_input {

/// The sweeps of one 3D LiDAR, and their defects. Not thread-safe.
class LidarStream {
 public:
  /// `stream`: role, topic, frame and number of messages. `delay`: ns, subtracted from all stamps.
  LidarStream(InputStream stream, const urban_nav_core::Pose& T_base_lidar, urban_nav_core::CloudOptions options,
              urban_nav_core::StampNs delay);

  /// Sets the convention for reading clouds.
  void setConvention(urban_nav_core::CloudConvention convention);
  /// Returns the sweep of a cloud; nullopt, and counted, if it has no beams or is not later than the previous one.
  std::optional<SweepInput> read(const urban_nav_core::CloudView& cloud);
  /// Counts a cloud that cannot be read.
  void addFault(const std::string& fault) { examination_->addFault(fault); }

  const std::string& topic() const { return stream_.topic; }
  const urban_nav_core::CloudOptions& options() const { return options_; }
  /// Returns the stream with the convention of its clouds.
  InputStream describe() const;
  /// Returns a sentence on the convention of its clouds.
  std::string note() const;
  std::vector<Finding> findings() const { return examination_->findings(); }
  /// Reads or writes the state between two clouds.
  void archive(urban_nav_core::Archive& archive);

 private:
  InputStream stream_;
  urban_nav_core::Pose T_base_lidar_;
  urban_nav_core::CloudOptions options_;
  urban_nav_core::StampNs delay_;
  urban_nav_core::CloudConvention convention_;
  std::optional<urban_nav_core::SweepReader> reader_;
  std::optional<SweepExamination> examination_;
  urban_nav_core::StampNs last_ = 0;  // reference of the last sweep
};

/// Returns the options of a LiDAR from those of the user. `are_deskewed`: default for the kind of input.
urban_nav_core::CloudOptions toCloudOptions(const PointsOptions& points, bool are_deskewed);

}  // namespace urban_nav_input
