// SPDX-License-Identifier: BSD-3-Clause
// Renders the scans of a session store along a trajectory, the true one for example, and reports its speed:
//   render_store STORE TRAJECTORY.tum MAP.ply
// The store receives the rendered chunks: pass a copy.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "laser_mapper/quality/map_quality.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper::bench {

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void renderStore(const std::string& store_path, const std::string& trajectory_path, const std::string& map_path,
                 int threads, bool leave_out) {
  const urban_nav_core::ThreadLimit limit(threads);
  urban_nav_store::Store store(store_path, urban_nav_store::Access::Write);
  const urban_nav_core::Trajectory trajectory = urban_nav_core::readTum(trajectory_path);
  const auto sessions = store.sessions().all();
  if (sessions.empty()) throw std::runtime_error(store_path + ": no session");
  Parameters parameters;
  parameters.ghosts = leave_out;
  const auto begin = std::chrono::steady_clock::now();
  LaserMap map(parameters, store, {{sessions.front().id, &trajectory, nullptr}});
  const RenderStatistics rendered = map.render();
  const double render_s = secondsSince(begin);
  urban_nav_core::PlyWriter file(map_path, mapLayout());
  const std::size_t ghosts = map.forEachTile([&](const Tile&, const std::vector<MapPoint>& points) {
    std::string bytes;
    for (const MapPoint& point : points) appendVertex(bytes, point);
    file.append(bytes);
  });
  const std::size_t points = file.vertices();
  file.commit();
  const double all_s = secondsSince(begin);
  const auto beams = static_cast<double>(rendered.beams.all);
  std::printf("%zu of %zu chunks, %.0f beams, mixed %.2f %%, without pose %.2f %%, out of range %.2f %%, %zu points\n",
              rendered.chunks_rendered, rendered.chunks, beams,
              100.0 * static_cast<double>(rendered.beams.mixed) / beams,
              100.0 * static_cast<double>(rendered.beams.without_pose) / beams,
              100.0 * static_cast<double>(rendered.beams.out_of_range) / beams, points);
  std::printf("ghosts %.2f %%\n", 100.0 * static_cast<double>(ghosts) / beams);
  std::printf("render %.2f s, surfaces and file %.2f s, %.2f M beams/s on %d threads\n", render_s, all_s - render_s,
              1e-6 * beams / all_s, threads);
  const auto quality_begin = std::chrono::steady_clock::now();
  const MapQuality quality(map);
  for (const auto& [name, figures] : {std::pair{"walls", quality.walls()}, std::pair{"ground", quality.ground()}})
    std::printf("%s: %zu places, %zu pairs, %.2f deg (largest %.2f, noise %.2f), %.1f mm (largest %.1f, noise %.1f)\n",
                name, figures.places, figures.pairs, 180.0 / M_PI * figures.angle.mean,
                180.0 / M_PI * figures.angle.largest, 180.0 / M_PI * figures.angle.sigma,
                1e3 * figures.displacement.mean, 1e3 * figures.displacement.largest, 1e3 * figures.displacement.sigma);
  std::printf("quality %.2f s\n", secondsSince(quality_begin));
  for (const std::string& warning : rendered.warnings) std::printf("%s\n", warning.c_str());
}

}  // namespace laser_mapper::bench

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::fprintf(stderr, "usage: render_store STORE TRAJECTORY.tum MAP.ply [THREADS [--keep-ghosts]]\n");
    return 2;
  }
  laser_mapper::bench::renderStore(argv[1], argv[2], argv[3], argc > 4 ? std::stoi(argv[4]) : 1, argc < 6);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
