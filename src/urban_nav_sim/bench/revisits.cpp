// SPDX-License-Identifier: BSD-3-Clause
// Writes views of revisited places, for src/urban_nav_registration/bench/pairs.cpp: a folder in the layout of KITTI
// with the true poses. Three passes along one path: unchanged; shifted along it by some metres and by up to 1.6 m and
// 20 deg sideways; and shifted again on another day.
//   revisits [--world W] [--seed N] [--places 36] [--step 2] [--folder DIR]
#include <array>
#include <memory>
#include <string>

#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/program.hpp"
#include "support/stereo_folder.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::Pose;

constexpr double kStart = 6.0;  // s: the robot is moving
constexpr double kMostBefore = 2.5, kMostAside = 1.6, kMostTurned = 0.35, kMostTilted = 0.02,
                 kMostLifted = 0.02;        // s, m, rad, rad, m
constexpr int kPictures = 10;               // until the exposure has settled
constexpr double kBetweenPictures = 0.001;  // s

/// A motion shifted in time and sideways.
struct Aside : Motion {
  explicit Aside(const Motion& motion) : way(motion) {}
  double duration() const override { return way.duration(); }
  MotionState at(double t) const override {
    MotionState motion_state = way.at(t + later);
    motion_state.T_world_base = motion_state.T_world_base * T_path_base;
    return motion_state;
  }

  const Motion& way;
  double later = 0.0;
  Pose T_path_base;
};

void goAside(const Noise& noise, Aside& motion) {
  const auto draw = [&noise](std::uint64_t counter, double most) { return noise.uniform(counter, -most, most); };
  motion.later = draw(0, kMostBefore);
  motion.T_path_base = Pose(urban_nav_core::expSo3({draw(1, kMostTilted), draw(2, kMostTilted), draw(3, kMostTurned)}),
                            {0.0, draw(4, kMostAside), draw(5, kMostLifted)});
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  const std::string world = options.text("--world", "quad");
  const auto seed = static_cast<std::uint32_t>(options.number("--seed", 1.0));
  const int places = static_cast<int>(options.number("--places", 36.0));
  const double step = options.number("--step", 2.0);  // s of the motion
  const Pose T_base_left = sensorPose(urban_nav_core::frames::kStereoLeft);
  const Noise noise(seed, "revisits");
  StereoFolder folder(options.text("--folder", world));
  DriveOptions ride_options;
  ride_options.duration = kStart + kMostBefore + step * places + 1.0;
  for (const int pass : {0, 1, 2}) {
    const World on_day = buildWorld(world, seed, pass == 2 ? 2 : 1);
    const auto way = simulateDrive(on_day, makeRoute(world, seed, "loops"), ride_options);
    const Tracer tracer(on_day);
    const Sky sky(on_day.day, noise.of("sky").bits(0));
    const Noise here = noise.of(static_cast<std::uint64_t>(pass));
    StereoHead head(tracer, sky, StereoImages::Rectified, T_base_left, here.bits(0));
    Aside motion(*way);
    for (int place = 0; place < places; ++place) {
      if (pass > 0) goAside(here.of(static_cast<std::uint64_t>(place)), motion);
      double t = kStart + step * place;
      std::array<cv::Mat, 2> images = head.take(motion, t);
      for (int again = 1; place == 0 && again < kPictures; ++again) images = head.take(motion, t += kBetweenPictures);
      folder.add(images, motion.at(t).T_world_base * T_base_left);
    }
  }
  folder.finish(bumblebee(StereoImages::Rectified));
  return 0;
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
