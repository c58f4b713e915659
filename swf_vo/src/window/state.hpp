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

/// An active pose x_p(j) with the process term that ties it to the pose before.
struct PoseBlock {
  FrameId frame = 0;
  urban_nav_core::Pose estimate;
  urban_nav_core::Pose linearised;  ///< where Jacobians are taken
  ProcessInput u;                   ///< from the pose before; unused by the oldest
  bool u_solved = false;            ///< the last solve had this process term
  PoseMatrices at_estimate, at_linearised;
};

/// z_ij with its weight. `step` counts poses since the window began: pose j stands at State::poses[step - first_step].
struct Measurement {
  std::int64_t step = 0;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix2d template_drift_covariance =
      Eigen::Matrix2d::Zero();  ///< of the bearing, since the measurement before
  double sigma_px = 0.0;        ///< of the alignment alone
  double inflation = 1.0;       ///< Observation::inflation
  double weight = 1.0;          ///< robust weight at the last linearisation; 0: not in front of the camera
  bool solved = false;          ///< the last solve had this measurement
};

/// A landmark x_m(i) with what active poses saw of it, in order of pose.
struct LandmarkBlock {
  LandmarkId id = 0;
  Anchor anchor;
  Eigen::Vector3d estimate = Eigen::Vector3d::Zero();
  Eigen::Vector3d linearised = Eigen::Vector3d::Zero();
  int prior = -1;  ///< which landmark of the prior; -1: the prior does not touch it
  Eigen::Matrix2d template_drift_covariance =
      Eigen::Matrix2d::Zero();  ///< of the bearing, since what the prior knows of it
  bool used = false;            ///< false: the slot is free
  bool known = false;           ///< its place is given: a constant, not a state
  bool followed = true;         ///< still looked for
  std::vector<Measurement> seen;
};

void archive(urban_nav_core::Archive& archive, ProcessInput& u);
void archive(urban_nav_core::Archive& archive, Anchor& anchor);
void archive(urban_nav_core::Archive& archive, PoseBlock& pose);
void archive(urban_nav_core::Archive& archive, LandmarkBlock& landmark);

/// x = (x_m, x_p): what is active, where it was linearised. Holds and does not compute. Slots of landmarks are reused,
/// with the memory of their measurements, so that a steady state allocates nothing.
class State {
 public:
  std::vector<PoseBlock> poses;          ///< oldest first
  std::int64_t first_step = 0;           ///< of poses.front()
  std::vector<LandmarkBlock> landmarks;  ///< by slot
  double disparity_offset = 0.0;         ///< px, of the camera (StereoCamera): one number for all frames

  std::int64_t newestStep() const { return first_step + static_cast<std::int64_t>(poses.size()) - 1; }
  /// Place in `poses`, -1 if the frame is not active.
  int toPose(FrameId frame) const;
  /// Slot of a landmark, -1 if unknown.
  int findSlot(LandmarkId landmark) const;
  /// As much room as another has, so that copies of it allocate nothing.
  void reserveLike(const State& other);
  /// Room for so many landmarks.
  void reserve(std::size_t slots);
  /// A free slot for a new landmark.
  int add(LandmarkId landmark);
  void remove(int slot);
  void archive(urban_nav_core::Archive& archive);

 private:
  void check(const urban_nav_core::Archive& archive) const;

  std::vector<std::pair<LandmarkId, int>> slots_;  // sorted by id
  std::vector<int> free_;
};

}  // namespace swf_vo
