// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "urban_nav_core/testing/tracks.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Information of a stereo pixel with independent noise.
inline Eigen::Matrix3d pixelInformation(double sigma_px) { return Eigen::Matrix3d::Identity() / (sigma_px * sigma_px); }

inline urban_nav_core::Matrix6d diagonalInformation(double sigma_translation, double sigma_rotation) {
  urban_nav_core::Vector6d d;
  d << Eigen::Vector3d::Constant(1.0 / (sigma_translation * sigma_translation)),
      Eigen::Vector3d::Constant(1.0 / (sigma_rotation * sigma_rotation));
  return d.asDiagonal();
}

/// 25 features that enter and leave the view as the camera drives, turns and stops.
inline urban_nav_core::testing::TrackOptions mixedMotion(int frames, double sigma_px, std::uint64_t seed) {
  urban_nav_core::testing::TrackOptions motion;
  motion.seed = seed;
  motion.frames = frames;
  motion.features = 25;
  motion.sigma_px = sigma_px;
  motion.motion = urban_nav_core::testing::TrackMotion::Mixed;
  return motion;
}

/// Runs a Window on simulated tracks, one step per call.
class TrackRunner {
 public:
  TrackRunner(const urban_nav_core::testing::Tracks& tracks, const WindowOptions& options)
      : tracks_(tracks), window(options, tracks.camera) {
    first_information = diagonalInformation(1e-3, 1e-4);
  }

  /// Process input of a step: by default the true motion with a fixed error, and an information to match.
  ProcessInput input(std::size_t i) const {
    ProcessInput u;
    const urban_nav_core::Pose truth =
        tracks_.frames[i - 1].T_world_camera.inverse() * tracks_.frames[i].T_world_camera;
    urban_nav_core::Vector6d off;
    off << 0.01, -0.006, 0.012, 0.003, 0.004, -0.002;
    u.T_from_to = urban_nav_core::boxPlus(truth, off * (i % 2 == 0 ? 1.0 : -1.0));
    u.information = diagonalInformation(0.03, 0.01);
    return u;
  }

  bool done() const { return next_ >= tracks_.frames.size(); }
  std::size_t at() const { return next_ - 1; }

  void beginStep() {
    const FrameId frame = static_cast<FrameId>(next_);
    if (next_ == 0) window.start(frame, tracks_.frames[0].T_world_camera, first_information);
    else window.addPose(frame, input(next_));
    window.removePoses();
    for (const SettledPose& pose : window.settled()) settled.push_back(pose);
  }

  std::vector<Observation> observations(std::size_t i) const {
    std::vector<Observation> result;
    for (const urban_nav_core::testing::TrackSighting& sighting : tracks_.frames[i].sightings)
      result.push_back({sighting.landmark, static_cast<FrameId>(i), sighting.z, pixelInformation(tracks_.sigma_px)});
    return result;
  }

  UpdateReport endStep() {
    for (const std::int64_t landmark : tracks_.frames[next_].ended) window.endLandmark(landmark);
    ++next_;
    return window.update();
  }

  UpdateReport step(const std::function<bool(const Observation&)>& wanted = {}) {
    beginStep();
    for (const Observation& observation : observations(next_))
      if (!wanted || wanted(observation)) window.observe(observation);
    return endStep();
  }

  const urban_nav_core::Pose& truth() const { return tracks_.frames[at()].T_world_camera; }

 private:
  const urban_nav_core::testing::Tracks& tracks_;
  std::size_t next_ = 0;

 public:
  Window window;
  urban_nav_core::Matrix6d first_information;
  std::vector<SettledPose> settled;
};

}  // namespace swf_vo
