// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/tracks.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_core::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

StereoCamera usualCamera() { return {{400.0, 400.0, 255.5, 191.5, 512, 384}, 0.12}; }

// Camera axes: z forward, x right, y down; heading turns about y.
std::vector<Pose> drive(const TrackOptions& options) {
  std::vector<Pose> poses;
  double heading = 0.0;
  Vector3d t = Vector3d::Zero();
  for (int i = 0; i < options.frames; ++i) {
    const double along = static_cast<double>(i);
    const double tilt = options.motion == TrackMotion::Standing ? 0.0 : 0.02;
    const Quaterniond level = expSo3(Vector3d(0.0, heading, 0.0));
    const Quaterniond shaken =
        expSo3(Vector3d(tilt * std::sin(0.31 * along), 0.0, 0.7 * tilt * std::sin(0.23 * along)));
    poses.emplace_back(level * shaken, t);
    double speed = options.speed, turn = 0.0;
    const int phase = i % 100;
    if (options.motion == TrackMotion::Standing) speed = 0.0;
    if (options.motion == TrackMotion::Turning) turn = 0.06 * std::sin(0.07 * along);
    if (options.motion == TrackMotion::Mixed) {
      if (phase >= 20 && phase < 65) turn = 2.0 * kPi / 45.0;
      if (phase >= 80) speed = 0.0;
    }
    heading += turn;
    t += level * Vector3d(0.0, 0.0, speed);
  }
  return poses;
}

bool project(const StereoCamera& camera, const Pose& T_world_camera, const Vector3d& p_world, Vector3d& z) {
  const Vector3d p = T_world_camera.R().transpose() * (p_world - T_world_camera.t());
  if (p.z() < 0.5) return false;
  z.x() = camera.left.cx + camera.left.fx * p.x() / p.z();
  z.y() = camera.left.cy + camera.left.fy * p.y() / p.z();
  z.z() = camera.left.cx + camera.left.fx * (p.x() - camera.baseline) / p.z();
  return z.x() > 0.0 && z.x() < camera.left.width - 1 && z.y() > 0.0 && z.y() < camera.left.height - 1 && z.z() > 0.0;
}

struct Alive {
  std::int64_t landmark = 0;
  int last = 0;  // frame after which it is not followed any more
};

}  // namespace

Tracks simulateTracks(const TrackOptions& options) {
  Dice dice(options.seed);
  Tracks tracks;
  tracks.camera = usualCamera();
  tracks.sigma_px = options.sigma_px;
  const StereoCamera& camera = tracks.camera;
  std::vector<Alive> alive;
  const std::vector<Pose> poses = drive(options);
  for (int i = 0; i < options.frames; ++i) {
    TrackFrame frame;
    frame.T_world_camera = poses[static_cast<std::size_t>(i)];
    Vector3d z;
    const auto add = [&](std::int64_t landmark) {
      TrackSighting sighting;
      sighting.landmark = landmark;
      sighting.z = z + options.sigma_px * Vector3d(dice.normal(), dice.normal(), dice.normal());
      sighting.outlier = dice.uniform() < options.outliers;
      if (sighting.outlier)
        sighting.z += Vector3d(dice.uniform(-20.0, 20.0), dice.uniform(-20.0, 20.0), dice.uniform(-20.0, 20.0));
      frame.sightings.push_back(sighting);
    };
    std::vector<Alive> still;
    for (const Alive& track : alive) {
      if (!project(camera, frame.T_world_camera, tracks.points[static_cast<std::size_t>(track.landmark)], z)) {
        frame.ended.push_back(track.landmark);
        continue;
      }
      if (dice.uniform() >= options.missed) add(track.landmark);
      if (track.last > i) still.push_back(track);
      else frame.ended.push_back(track.landmark);
    }
    while (static_cast<int>(frame.sightings.size()) < options.features) {
      const Vector3d pixel(dice.uniform(5.0, camera.left.width - 6.0), dice.uniform(5.0, camera.left.height - 6.0),
                           0.0);
      const double depth = options.nearest * std::pow(options.farthest / options.nearest, dice.uniform());
      const double life = std::log(dice.uniform()) / std::log(1.0 - 1.0 / std::max(1.0 + 1e-9, options.track_length));
      const Vector3d p((pixel.x() - camera.left.cx) / camera.left.fx * depth,
                       (pixel.y() - camera.left.cy) / camera.left.fy * depth, depth);
      const Vector3d p_world = frame.T_world_camera * p;
      if (!project(camera, frame.T_world_camera, p_world, z)) continue;
      const std::int64_t landmark = static_cast<std::int64_t>(tracks.points.size());
      tracks.points.push_back(p_world);
      add(landmark);
      const Alive track{landmark, i + static_cast<int>(std::min(life, 1e6))};
      if (track.last > i) still.push_back(track);
      else frame.ended.push_back(landmark);
    }
    alive.swap(still);
    tracks.frames.push_back(std::move(frame));
  }
  return tracks;
}

}  // namespace urban_nav_core::testing
