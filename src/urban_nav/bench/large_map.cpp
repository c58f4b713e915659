// SPDX-License-Identifier: BSD-3-Clause
// Writes a store with a large map, and reports the speed and size of its tiles: sessions along parallel streets of
// ground and walls, with poses 10 cm apart, without the measurements from which a map is rendered.
//
//   urban_nav-bench-large_map STORE [MILLIONS_OF_POINTS [SESSIONS]]
//
// large_map.py measures the page of `view` on it.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "laser_mapper/tiles/tile_store.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav::bench {

using laser_mapper::MapPoint;
using laser_mapper::Tile;
using urban_nav_core::StampNs;
using urban_nav_store::Store;

constexpr double kVoxel = 0.05, kTileWidth = kVoxel * laser_mapper::kTileCells;  // m
constexpr double kHalfStreet = 9.0, kWallHeight = 8.0;                           // m
constexpr int kRowsApart = 4;                                                    // tiles between two streets
constexpr double kPointsPerMetre = (2.0 * kHalfStreet + 2.0 * kWallHeight) / kVoxel / kVoxel;
constexpr double kPoseStep = 0.1;  // m
constexpr StampNs kPoseInterval = 100'000'000, kSessionInterval = 86'400'000'000'000;

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A number in 0...1 that depends on a point.
double noiseAt(std::uint32_t a, std::uint32_t b) {
  std::uint32_t bits = a * 0x9e3779b1U ^ b * 0x85ebca77U;
  bits = (bits ^ bits >> 15U) * 0x2c1b3c6dU;
  bits = (bits ^ bits >> 12U) * 0x297a2d39U;
  return static_cast<double>(bits ^ bits >> 15U) / 4294967296.0;
}

class Streets {
 public:
  Streets(Store& store, std::size_t sessions, std::size_t tiles) : store_(store), tiles_(tiles) {
    for (std::size_t s = 0; s < sessions; ++s) putSession(s);
    store.commit();
  }

  std::size_t writeTiles() {
    laser_mapper::TileWriter writer(store_, sessions_, kVoxel);
    std::size_t count = 0;
    for (std::size_t s = 0; s < sessions_.size(); ++s)
      for (const int side : {-1, 0})
        for (std::size_t x = 0; x < tiles_; ++x) {
          const Tile tile{static_cast<int>(x), static_cast<int>(s) * kRowsApart + side};
          const std::vector<MapPoint> points = tilePoints(tile, s);
          count += points.size();
          writer.add(tile, points);
        }
    writer.finish();
    return count;
  }

  double length() const { return static_cast<double>(tiles_) * kTileWidth; }

 private:
  void putSession(std::size_t number) {
    char id[24];
    std::snprintf(id, sizeof id, "%016zx", number + 1);
    const StampNs first = 1'225'719'872'000'000'000 + static_cast<StampNs>(number) * kSessionInterval;
    store_.sessions().put({id, "street" + std::to_string(number + 1), "", "", first, true});
    store_.sessions().put(urban_nav_store::Anchor{id, "0000000000000001", 1, {}});
    laser_mapper::TiledSession session{id, static_cast<std::uint16_t>(number), {}};
    const auto poses = static_cast<std::size_t>(length() / kPoseStep);
    for (std::size_t i = 0; i < poses; ++i) {
      urban_nav_store::Node node;
      node.stamp = first + static_cast<StampNs>(i) * kPoseInterval;
      node.T_odom_base = urban_nav_core::Pose(
          Eigen::Quaterniond::Identity(),
          {kPoseStep * static_cast<double>(i), kTileWidth * kRowsApart * static_cast<double>(number), 0.0});
      store_.graph().put(id, node);
      session.stamps.push_back(node.stamp);
    }
    sessions_.push_back(std::move(session));
  }

  void add(std::vector<MapPoint>& points, std::size_t session, const Eigen::Vector3d& p, bool is_wall) const {
    const auto a = static_cast<std::uint32_t>(std::lround(p.x() / kVoxel)),
               b = static_cast<std::uint32_t>(std::lround((p.y() + 3.0 * p.z()) / kVoxel));
    MapPoint point;
    point.p = (p + 0.02 * Eigen::Vector3d(noiseAt(a, b), noiseAt(b, a), noiseAt(a + 1, b))).cast<float>();
    const double grey = 90.0 + 60.0 * std::sin(0.3 * p.x()) * std::sin(0.7 * p.z()) + 30.0 * noiseAt(a, b + 1);
    point.red = static_cast<std::uint8_t>(is_wall ? grey + 40.0 : grey);
    point.green = static_cast<std::uint8_t>(is_wall ? grey : grey + 15.0);
    point.blue = static_cast<std::uint8_t>(0.8 * grey);
    point.intensity = static_cast<std::uint8_t>(grey);
    point.sigma = 0.004F + 0.003F * static_cast<float>(noiseAt(a + 2, b));
    point.laser = p.y() < 0.0 ? 0 : 1;
    point.pass = static_cast<std::uint16_t>(session);
    const std::vector<StampNs>& stamps = sessions_[session].stamps;
    point.stamp = stamps[std::min(stamps.size() - 1, static_cast<std::size_t>(std::max(0.0, p.x()) / kPoseStep))];
    points.push_back(point);
  }

  std::vector<MapPoint> tilePoints(const Tile& tile, std::size_t session) const {
    std::vector<MapPoint> points;
    const double x0 = tile.x * kTileWidth, middle = kTileWidth * kRowsApart * static_cast<double>(session);
    const double side = tile.y * kTileWidth < middle ? -1.0 : 1.0;
    for (int i = 0; i < laser_mapper::kTileCells; ++i) {
      const double x = x0 + kVoxel * i + 0.01;
      for (double y = 0.02; y < kHalfStreet; y += kVoxel) add(points, session, {x, middle + side * y, 0.01}, false);
      for (double z = 0.02; z < kWallHeight; z += kVoxel)
        add(points, session, {x, middle + side * kHalfStreet, z}, true);
    }
    return points;
  }

  Store& store_;
  const std::size_t tiles_;
  std::vector<laser_mapper::TiledSession> sessions_;
};

void writeLargeMap(const std::string& path, double millions, std::size_t sessions) {
  urban_nav_store::removeStore(path);
  const double metres = 1e6 * millions / kPointsPerMetre / static_cast<double>(sessions);
  const auto tiles = static_cast<std::size_t>(std::max(1.0, std::round(metres / kTileWidth)));
  std::size_t points = 0;
  double seconds = 0.0;
  {
    Store store(path, urban_nav_store::Access::Write);
    Streets streets(store, sessions, tiles);
    const auto without = std::filesystem::file_size(path);
    const auto begin = std::chrono::steady_clock::now();
    points = streets.writeTiles();
    seconds = secondsSince(begin);
    std::printf("%zu sessions of %.0f m, %.1f M points, %.1f MB without tiles\n", sessions, streets.length(),
                1e-6 * static_cast<double>(points), 1e-6 * static_cast<double>(without));
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::printf("tiles written at %.2f M points/s, store %.1f MB, %.1f bytes a point, peak memory %.0f MB\n",
              1e-6 * static_cast<double>(points) / seconds, 1e-6 * size, size / static_cast<double>(points),
              1e-3 * static_cast<double>(usage.ru_maxrss));
}

}  // namespace urban_nav::bench

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s STORE [MILLIONS_OF_POINTS [SESSIONS]]\n", argv[0]);
    return 2;
  }
  urban_nav::bench::writeLargeMap(argv[1], argc > 2 ? std::atof(argv[2]) : 100.0,
                                  argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : 20);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
