// SPDX-License-Identifier: BSD-3-Clause
// Writes clouds of two lasers around places along a motion, for src/urban_nav_registration/bench/clouds.cpp: a PLY per
// place, as from a recording with drifting odometry, and places.csv with the day, the distance driven (m) and the true
// pose of each. The same route on two days.
//   local_clouds [--world W] [--seed N] [--route loops] [--duration 300] [--step 4] [--folder DIR]
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "laser/lms291.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/program.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

constexpr double kBeside = 10.0;            // m before and after a place: loop_metric.cloud_half_length
constexpr double kStart = 6.0;              // s: the robot is moving
constexpr double kFrame = 0.05;             // s from pose to pose of odometry
constexpr std::uint64_t kTurns = 10000000;  // per day, so that the noise differs
constexpr StampNs kLongestGap = 500000000;

// Drift of swf_vo per root of a metre in `quad` (two days of 300 m, segments of 10 m): m, rad.
const Eigen::Vector3d kDriftAlong(2.2e-3, 2.0e-3, 1.0e-3), kDriftTurned(0.16e-3, 0.16e-3, 0.22e-3);

// Resulting deformation of a cloud, m: mean variance along the path of a random walk minus its mean, with rotations at
// 10 m.
const double kBend =
    std::sqrt(2.0 * kBeside / 6.0 * (kDriftAlong.squaredNorm() + 100.0 * kDriftTurned.squaredNorm()) / 3.0);

StampNs toStamp(double t) { return static_cast<StampNs>(std::llround(1e9 * t)); }

/// The true path and its odometry, frame by frame.
struct Driven {
  std::vector<double> t, way;  // s, m
  std::vector<Pose> T_world_base;
  Trajectory odometry;

  Driven(const Motion& motion, const Noise& noise) {
    Pose T_first_base;
    for (double now = kStart; now < motion.duration(); now += kFrame) {
      const Pose pose = motion.at(now).T_world_base;
      double length = 0.0;
      if (!t.empty()) {
        const Pose step = T_world_base.back().inverse() * pose;
        length = step.t().norm();
        const double root = std::sqrt(length);
        const Eigen::Vector3d off = root * kDriftAlong.cwiseProduct(noise.of("along").normal3(t.size())),
                              turn = root * kDriftTurned.cwiseProduct(noise.of("turned").normal3(t.size()));
        T_first_base = T_first_base * step * Pose(urban_nav_core::expSo3(turn), off);
      }
      way.push_back(way.empty() ? 0.0 : way.back() + length);
      t.push_back(now);
      T_world_base.push_back(pose);
      odometry.append(toStamp(now), T_first_base);
    }
  }
};

struct Turn {
  double t = 0.0;
  urban_nav_core::Scan scan;
};

void write(const std::string& path, const std::vector<urban_nav_core::LaserPoint>& points) {
  std::ofstream file(path, std::ios::binary);
  urban_nav_core::PlyLayout layout;
  for (const char* name : {"x", "y", "z", "origin_x", "origin_y", "origin_z"})
    layout.properties.push_back({name, urban_nav_core::PlyType::Float});
  file << urban_nav_core::plyHeader(layout, points.size());
  for (const urban_nav_core::LaserPoint& point : points)
    for (const Eigen::Vector3f* part : {&point.p, &point.origin})
      file.write(reinterpret_cast<const char*>(part->data()), 3 * sizeof(float));
  if (!file) throw std::runtime_error(path + ": not written");
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  const std::string world = options.text("--world", "quad"), folder = options.text("--folder", world);
  const auto seed = static_cast<std::uint32_t>(options.number("--seed", 1.0));
  const double step = options.number("--step", 4.0);  // m
  DriveOptions ride_options;
  ride_options.duration = options.number("--duration", 300.0);
  std::filesystem::create_directories(folder);
  std::ofstream places(folder + "/places.csv");
  places.precision(17);
  places << "cloud,day,way,x,y,z,qx,qy,qz,qw,bend\n";
  int count = 0;
  for (const int day : {1, 2}) {
    const World on_day = buildWorld(world, seed, day);
    ride_options.seed = seed + 1000U * static_cast<std::uint32_t>(day);
    const auto motion = simulateDrive(on_day, makeRoute(world, seed, options.text("--route", "loops")), ride_options);
    const Tracer tracer(on_day);
    const Driven driven(*motion, Noise(seed, "local clouds").of(static_cast<std::uint64_t>(day)));
    const std::vector<std::string> frames = {urban_nav_core::frames::kLaserLeft, urban_nav_core::frames::kLaserRight};
    std::vector<std::vector<Turn>> turns(frames.size());
    for (std::size_t laser = 0; laser < frames.size(); ++laser) {
      const Lms291::Settings settings;
      const Lms291 device(tracer, sensorPose(frames[laser]), seed, frames[laser], settings);
      std::uint64_t number = kTurns * static_cast<std::uint64_t>(day);
      for (double t = kStart; t < driven.t.back() - settings.period; t += settings.period)
        turns[laser].push_back({t, toScan(device.scan(*motion, t, toStamp(t), number++))});
    }
    double next = kBeside;
    for (std::size_t at = 0; at < driven.t.size() && driven.way[at] + kBeside < driven.way.back(); ++at) {
      if (driven.way[at] < next) continue;
      next += step;
      std::size_t first = at, last = at;
      while (first > 0 && driven.way[at] - driven.way[first - 1] <= kBeside) --first;
      while (driven.way[last + 1] - driven.way[at] <= kBeside) ++last;
      std::vector<urban_nav_core::LaserPoint> points;
      for (std::size_t laser = 0; laser < frames.size(); ++laser) {
        urban_nav_core::BeamRenderer renderer(driven.odometry, sensorPose(frames[laser]),
                                              driven.odometry[at].pose.inverse(), kLongestGap);
        for (const Turn& turn : turns[laser])
          if (turn.t >= driven.t[first] && turn.t <= driven.t[last]) renderer.render(turn.scan, points);
      }
      std::string name = std::to_string(count++) + ".ply";
      write(folder + "/" + name, points);
      const Pose& pose = driven.T_world_base[at];
      places << name << "," << day << "," << driven.way[at];
      for (const double value :
           {pose.t().x(), pose.t().y(), pose.t().z(), pose.q().x(), pose.q().y(), pose.q().z(), pose.q().w()})
        places << "," << value;
      places << "," << kBend << "\n";
    }
  }
  return 0;
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
