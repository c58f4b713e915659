// SPDX-License-Identifier: BSD-3-Clause
// Time to render a large map again after a relaxation: laser scans of simulated bags (`simulate --sensors lasers`), as
// adjacent sessions in one map along their true trajectories, with the shipped parameters.
//
//   urban_nav-bench-map_size [-o FILE.json] [--threads N] BAG...
//
// A bag may be given several times, each time as another session at another position.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "support/laser_sessions.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/peak_memory.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav::bench {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::testing::cell;
using urban_nav_store::Store;

constexpr double kApart = 400.0;              // m between the origins of two sessions
constexpr double kShift = 0.3, kTurn = 0.01;  // m, rad: amplitudes of the change by a relaxation
constexpr double kWave = 200.0;               // s
constexpr double kClosureShare = 0.1;         // share of one session, moved by an additional closure

/// Returns the trajectory with its last `share` displaced by a slow wave.
Trajectory relaxed(const Trajectory& before, double share) {
  Trajectory after;
  const auto first = static_cast<std::size_t>((1.0 - share) * static_cast<double>(before.size()));
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double wave = i < first
                            ? 0.0
                            : std::sin(2.0 * M_PI / kWave *
                                       (1.0 + urban_nav_core::secondsBetween(before[first].stamp, before[i].stamp)));
    urban_nav_core::Vector6d motion = urban_nav_core::Vector6d::Zero();
    motion(0) = kShift * wave;
    motion(5) = kTurn * wave;
    after.append(before[i].stamp, urban_nav_core::boxPlus(before[i].pose, motion));
  }
  return after;
}

struct Drive {
  urban_nav_store::SessionId id;
  Trajectory trajectory;
};

/// Writes the scans of a bag to the store, next to the previous drives. Returns its length, m.
double addDrive(const std::string& bag, Store& store, std::vector<Drive>& drives) {
  char id[21];
  std::snprintf(id, sizeof(id), "%020zu", drives.size() + 1);
  putLaserSession(bag, id, "drive" + std::to_string(drives.size() + 1), store);
  const Pose place(urban_nav_core::Quaterniond::Identity(), {kApart * static_cast<double>(drives.size()), 0.0, 0.0});
  Drive drive{id, {}};
  double length = 0.0;
  const Trajectory truth = trueTrajectory(bag);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    drive.trajectory.append(truth[i].stamp, place * truth[i].pose);
    if (i > 0) length += (truth[i].pose.t() - truth[i - 1].pose.t()).norm();
  }
  drives.push_back(std::move(drive));
  return length;
}

struct Made {
  laser_mapper::RenderStatistics rendered;
  double seconds = 0.0, processor_s = 0.0, bytes = 0.0;
  std::size_t points = 0;
};

/// Renders the moved parts and writes the map.
Made render(const std::vector<Drive>& drives, Store& store, const std::string& path) {
  Made made;
  std::vector<laser_mapper::MappedSession> sessions;
  for (const Drive& drive : drives) sessions.push_back({drive.id, &drive.trajectory, nullptr});
  const double processor = urban_nav_core::testing::processMs();
  const auto begin = std::chrono::steady_clock::now();
  made.bytes = urban_nav_core::testing::measureMemory([&] {
    laser_mapper::LaserMap map({}, store, sessions);
    made.rendered = map.render();
    urban_nav_core::PlyWriter file(path, laser_mapper::mapLayout());
    map.forEachTile([&](const laser_mapper::Tile&, const std::vector<laser_mapper::MapPoint>& points) {
      std::string bytes;
      for (const laser_mapper::MapPoint& point : points) laser_mapper::appendVertex(bytes, point);
      file.append(bytes);
    });
    made.points = file.vertices();
    file.commit();
  });
  made.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  made.processor_s = 1e-3 * (urban_nav_core::testing::processMs() - processor);
  return made;
}

}  // namespace urban_nav::bench

int main(int argc, char** argv) {
  using namespace urban_nav::bench;
  urban_nav_core::testing::BenchTable table({"map", "M beams", "chunks", "rendered again", "s", "s of one core",
                                             "M beams/s of one core", "MB at the peak", "M points"},
                                            argc, argv);
  std::string output;
  int threads = 2;
  std::vector<std::string> bags;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-o" && i + 1 < argc) output = argv[++i];
    else if (word == "--threads" && i + 1 < argc) threads = std::atoi(argv[++i]);
    else bags.push_back(word);
  }
  const urban_nav_core::ThreadLimit limit(threads);
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string store_path = (folder / "urban_nav_map_size.db").string();
  const std::string map_path = (folder / "urban_nav_map_size.ply").string();
  urban_nav_store::removeStore(store_path);
  double length = 0.0;
  {
    Store store(store_path, urban_nav_store::Access::Write);
    std::vector<Drive> drives;
    for (const std::string& bag : bags) length += addDrive(bag, store, drives);
    const auto add = [&](const std::string& name, const Made& made) {
      const double beams = static_cast<double>(made.rendered.beams.all);
      const double share =
          static_cast<double>(made.rendered.chunks_rendered) / static_cast<double>(made.rendered.chunks);
      table.add({name, cell(1e-6 * beams, 1), std::to_string(made.rendered.chunks),
                 std::to_string(made.rendered.chunks_rendered), cell(made.seconds, 1), cell(made.processor_s, 1),
                 share > 0.5 ? cell(1e-6 * beams / made.processor_s, 2) : "-", cell(1e-6 * made.bytes, 0),
                 cell(1e-6 * static_cast<double>(made.points), 1)});
      std::fputs((table.text() + "\n").c_str(), stderr);
    };
    add("rendered first", render(drives, store, map_path));
    for (Drive& drive : drives) drive.trajectory = relaxed(drive.trajectory, 1.0);
    add("after a relaxation that moves everything", render(drives, store, map_path));
    drives.back().trajectory = relaxed(drives.back().trajectory, kClosureShare);
    add("after one that moves a tenth of one session", render(drives, store, map_path));
  }
  urban_nav_store::removeStore(store_path);
  std::filesystem::remove(map_path);
  table.note(cell(1e-3 * length, 1) + " km in " + std::to_string(bags.size()) + " sessions; " +
             std::to_string(threads) + " threads. From the store to map.ply, normals, thinning and ghosts included.");
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
