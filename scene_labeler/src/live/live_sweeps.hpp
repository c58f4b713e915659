// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene_labeler/sweep/sweep_labeler.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace scene_labeler {

/// Labels the sweeps of 3D LiDARs while the robot drives. A sweep waits until odometry covers its time. If sweeps come
/// faster than they are labelled, the oldest are dropped and counted, so that labels stay current. Not thread-safe.
class LiveSweeps {
 public:
  /// `reference`: time to which the sweep refers; returns in the frame of the trajectory.
  using Take = std::function<void(urban_nav_core::StampNs reference,
                                  const std::vector<urban_nav_core::LaserPoint>& returns, const SweepLabels& labels)>;
  /// Statistics for the operator.
  struct Counts {
    std::size_t sweeps = 0, labelled = 0;
    std::size_t too_many = 0;   ///< dropped because they come faster than they are labelled
    std::size_t unplaced = 0;   ///< dropped because no odometry covered them
    std::size_t new_place = 0;  ///< of those labelled, in a kind of place without training data
    double last_ms = 0.0;       ///< time to label the last one
  };

  /// `T_odom_base` must outlive the object.
  LiveSweeps(const urban_nav_core::Trajectory& T_odom_base, Take take)
      : T_odom_base_(T_odom_base), take_(std::move(take)) {}

  void place(const std::string& frame, const urban_nav_core::Pose& T_base_lidar) { places_[frame] = T_base_lidar; }
  bool isPlaced(const std::string& frame) const { return places_.count(frame) != 0; }
  /// Adds a sweep of a placed LiDAR.
  void add(const std::string& frame, urban_nav_core::Sweep sweep);
  /// Labels the oldest sweep that odometry covers. Returns whether it labelled one.
  bool labelNext(const std::shared_ptr<const LabelModel>& model, int superpixel);
  /// Drops waiting sweeps and the cloud, since another drive or model begins. Mountings are kept.
  void clear();

  const Counts& counts() const { return counts_; }
  void forgetCounts() { counts_ = {}; }
  /// Returns a sentence if more than a tenth of the last sweeps were dropped as too many; else empty.
  std::string fault() const;

 private:
  struct WaitingSweep {
    std::string frame;
    urban_nav_core::Sweep sweep;
  };
  bool isCovered(const WaitingSweep& waiting) const;
  void dropOldest();
  void note(bool is_dropped);

  const urban_nav_core::Trajectory& T_odom_base_;
  const Take take_;
  std::map<std::string, urban_nav_core::Pose> places_;
  std::map<std::string, urban_nav_core::BeamRenderer> renderers_;
  std::deque<WaitingSweep> waiting_;
  std::optional<SweepLabeler> labeler_;
  std::deque<bool> recent_;  // whether they were dropped as too many
  Counts counts_;
};

}  // namespace scene_labeler
