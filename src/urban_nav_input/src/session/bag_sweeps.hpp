// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/lidar_stream.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/cloud_messages.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// The 3D LiDARs of a recording and their sweeps, in the order of their references. Not thread-safe.
class BagSweeps {
 public:
  BagSweeps() = default;
  /// Determines the convention of each topic of 3D LiDARs from its first clouds. A LiDAR without transform is not used;
  /// without images (`has_images`), base_link is assumed at the only one. Throws UserError for a field of times that is
  /// missing in the clouds, DataError for a damaged recording.
  BagSweeps(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms,
            const PointsOptions& points, const ReceiptRange& part, bool has_images);

  bool empty() const { return streams_.empty(); }
  /// Returns the topics to read.
  std::vector<std::string> topics() const;
  /// Adds a message if it is of one of the topics; returns whether it is.
  bool add(const RecordedMessage& message);
  /// Marks all sweeps as ready, since no more messages follow for now.
  void flush();
  /// Returns the sweeps that are ready.
  std::vector<SweepInput> take();
  /// Returns the reference of the last sweep that was read; nullopt if the last message gave none.
  std::optional<urban_nav_core::StampNs> lastReference() const { return last_reference_; }

  std::vector<InputStream> streams() const;
  const std::vector<std::string>& notes() const { return notes_; }
  std::vector<Finding> findings() const;

  /// Reads or writes the state between two messages, when all sweeps were taken. Reading: the LiDARs and their
  /// conventions are those of the state.
  void archive(urban_nav_core::Archive& archive);

 private:
  bool survey(Recording& recording, const ReceiptRange& part, LidarStream& stream);
  void release(urban_nav_core::StampNs until);

  PointsOptions points_;
  CloudMessages messages_;
  std::vector<LidarStream> streams_;
  std::vector<urban_nav_core::StampNs> newest_;  // references, of each stream
  std::vector<SweepInput> waiting_, ready_;
  std::vector<Finding> findings_;
  std::vector<std::string> notes_;
  std::optional<urban_nav_core::StampNs> last_reference_;
};

}  // namespace urban_nav_input
