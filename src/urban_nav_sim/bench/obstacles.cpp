// SPDX-License-Identifier: BSD-3-Clause
// Writes stereo pairs of obstacles, for dense_stereo/bench/ground.cpp: a folder in the layout of KITTI, and in
// FOLDER/truth the depth and class of each pixel. At places along a route the robot is rotated by up to 60 deg, towards
// walls, plants, vehicles and furniture; a box of 12 to 60 cm is in front of it at each place.
//   obstacles [--world W] [--seed N] [--places 100] [--folder DIR]
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/program.hpp"
#include "support/stereo_folder.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "world/site.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::Pose;

constexpr double kBetween = 3.0, kBegin = 3.0;                                    // s of the drive
constexpr double kAside = 1.05;                                                   // rad
constexpr double kNearest = 1.3, kFarthest = 4.3, kSideways = 0.35;               // m; of the distance
constexpr double kThinnest = 0.1, kWidest = 0.5, kLowest = 0.12, kHighest = 0.6;  // m
constexpr double kSpeed = 0.7;                                                    // m/s, for the motion blur

/// The motion at one time, with a rotated heading.
struct View : Motion {
  MotionState state;
  double duration() const override { return 1.0; }
  MotionState at(double /*t*/) const override { return state; }
};

MotionState turnAside(MotionState state, double angle) {
  state.T_world_base = state.T_world_base * Pose(urban_nav_core::expSo3({0.0, 0.0, angle}), Eigen::Vector3d::Zero());
  state.velocity_world = state.T_world_base.R() * Eigen::Vector3d(kSpeed, 0.0, 0.0);
  state.rate_base.setZero();
  return state;
}

/// A box on the ground before the robot.
void placeBox(Site& site, const Pose& T_world_base, Draw& draw) {
  constexpr MaterialKind kKinds[] = {MaterialKind::Ashlar, MaterialKind::Rubble, MaterialKind::Brick,
                                     MaterialKind::Render, MaterialKind::Slate,  MaterialKind::Bark};
  const double ahead = draw.uniform(kNearest, kFarthest);
  Eigen::Vector3d p = T_world_base * Eigen::Vector3d(ahead, draw.uniform(-kSideways, kSideways) * ahead, 0.0);
  p.z() = site.ground(p.x(), p.y());
  const Eigen::Vector3d size(draw.uniform(kThinnest, kWidest), draw.uniform(kThinnest, kWidest),
                             draw.uniform(kLowest, kHighest));
  const Finish finish{kKinds[draw.index(6)], static_cast<std::uint64_t>(draw.index(4)),
                      static_cast<std::uint32_t>(draw.bits() & 0xFFFFU)};
  site.box(finish, p, size, draw.uniform(0.0, M_PI));
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  const std::string name = options.text("--world", "quad"), path = options.text("--folder", name);
  const auto seed = static_cast<std::uint32_t>(options.number("--seed", 1.0));
  const int places = static_cast<int>(options.number("--places", 100.0));
  World world = buildWorld(name, seed, 1);
  DriveOptions ride;
  ride.duration = kBegin + kBetween * places + 1.0;
  const auto drive = simulateDrive(world, makeRoute(name, seed, "loops"), ride);
  Draw draw(hash(seed, 0x0B57));
  Site site(world, seed);
  std::vector<View> looks(static_cast<std::size_t>(places));
  for (int i = 0; i < places; ++i) {
    View& look = looks[static_cast<std::size_t>(i)];
    look.state = turnAside(drive->at(kBegin + kBetween * i), draw.uniform(-kAside, kAside));
    placeBox(site, look.state.T_world_base, draw);
  }
  const Tracer tracer(world);
  const Sky sky(world.day, seed);
  const Pose T_base_left = sensorPose(urban_nav_core::frames::kStereoLeft);
  StereoFolder folder(path);
  for (const View& look : looks) {
    // One head per place, so that its initial exposure is correct.
    StereoHead head(tracer, sky, StereoImages::Rectified, T_base_left, draw.bits());
    folder.add(head.take(look, 0.0), look.state.T_world_base * T_base_left);
    folder.addTruth(head.pictures(), path + "/truth");
  }
  folder.finish(bumblebee(StereoImages::Rectified));
  return 0;
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
