// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "observation.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "window/process_model.hpp"
#include "window/sensor_model.hpp"

namespace swf_vo {

/// An active pose x_p(j) with the process term that links it to the previous pose.
struct PoseBlock {
  FrameId frame = 0;
  urban_nav_core::Pose estimate;
  urban_nav_core::Pose linearised;  ///< linearisation point
  ProcessInput u;                   ///< from the previous pose; unused for the oldest
  bool u_solved = false;            ///< this process term was in the last solve
  PoseMatrices at_estimate, at_linearised;
};

/// z_ij with its weight. `step` counts poses since the start of the window: pose j is State::poses[step - first_step].
struct Measurement {
  std::int64_t step = 0;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix2d template_drift_covariance =
      Eigen::Matrix2d::Zero();  ///< for the bearing, since the previous measurement
  double sigma_px = 0.0;        ///< standard deviation of the alignment only
  double inflation = 1.0;       ///< Observation::inflation
  double weight = 1.0;          ///< robust weight at the last linearisation; 0: not in front of the camera
  bool solved = false;          ///< this measurement was in the last solve
};

/// A landmark x_m(i) with its measurements from active poses, in order of pose.
struct LandmarkBlock {
  LandmarkId id = 0;
  Anchor anchor;
  Eigen::Vector3d estimate = Eigen::Vector3d::Zero();
  Eigen::Vector3d linearised = Eigen::Vector3d::Zero();
  int prior = -1;  ///< index of the landmark in the prior; -1: not in the prior
  Eigen::Matrix2d template_drift_covariance =
      Eigen::Matrix2d::Zero();  ///< for the bearing, since the last update of the prior
  bool used = false;            ///< false: the slot is free
  bool known = false;           ///< known position: a constant, not a state
  bool followed = true;         ///< still tracked
  std::vector<Measurement> seen;
};

void archive(urban_nav_core::Archive& archive, ProcessInput& u);
void archive(urban_nav_core::Archive& archive, Anchor& anchor);
void archive(urban_nav_core::Archive& archive, PoseBlock& pose);
void archive(urban_nav_core::Archive& archive, LandmarkBlock& landmark);

/// x = (x_m, x_p): active states and their linearisation points. Data only. Slots of landmarks are reused, with the
/// memory of their measurements, so that a steady state does not allocate.
class State {
 public:
  std::vector<PoseBlock> poses;          ///< oldest first
  std::int64_t first_step = 0;           ///< step of poses.front()
  std::vector<LandmarkBlock> landmarks;  ///< indexed by slot
  double disparity_offset = 0.0;         ///< px, of the camera (StereoCamera): one number for all frames

  std::int64_t newestStep() const { return first_step + static_cast<std::int64_t>(poses.size()) - 1; }
  /// Returns the index in `poses`, -1 if the frame is not active.
  int toPose(FrameId frame) const;
  /// Returns the slot of a landmark, -1 if unknown.
  int findSlot(LandmarkId landmark) const;
  /// Reserves the capacity of another state, so that copies of it do not allocate.
  void reserveLike(const State& other);
  /// Reserves memory for this number of landmarks.
  void reserve(std::size_t slots);
  /// Returns a free slot for a new landmark.
  int add(LandmarkId landmark);
  void remove(int slot);
  void archive(urban_nav_core::Archive& archive);

 private:
  void check(const urban_nav_core::Archive& archive) const;

  std::vector<std::pair<LandmarkId, int>> slots_;  // sorted by id
  std::vector<int> free_;
};

}  // namespace swf_vo
