// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/tile_point.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "urban_nav_core/io/numbers.hpp"

namespace laser_mapper {

namespace {

constexpr float kSigmaStep = 0.5e-3F;          // m
constexpr int kTileShift = 16;                 // log2 of the steps of a tile of level 0
constexpr std::int32_t kLowestZ = -(1 << 23);  // steps
static_assert(kTileCells * kVoxelSteps == 1 << kTileShift);
static_assert((1 << (kCoarsestLevel + 1)) == kTileCells);
static_assert(kTileShift + kCoarsestLevel < 24);
static_assert((kMaxHeightCell + 1) * kVoxelSteps == -kLowestZ);

auto tied(const TilePoint& p) {
  return std::tie(p.z, p.y, p.x, p.session, p.pose, p.red, p.green, p.blue, p.reflectance, p.sensor, p.sigma);
}

/// Returns the steps from the origin of the map to the corner of a tile along one axis.
std::int32_t tileCorner(int tile, int level) {
  return static_cast<std::int32_t>(static_cast<std::int64_t>(tile) * (std::int64_t{1} << (kTileShift + level)));
}

/// Appends or reads columns of small numbers.
class Columns {
 public:
  Columns(std::string& bytes, std::size_t rows) : to_(&bytes), rows_(rows) {}
  Columns(std::string_view bytes, std::size_t rows) : from_(bytes), rows_(rows) {}

  template <typename Value>
  void append(int bytes, const Value& value) {
    for (int byte = 0; byte < bytes; ++byte)
      for (std::size_t i = 0; i < rows_; ++i)
        to_->push_back(static_cast<char>(static_cast<std::uint32_t>(value(i)) >> (8 * byte) & 0xffU));
  }
  template <typename Take>
  void read(int bytes, const Take& take) {
    for (std::size_t i = 0; i < rows_; ++i) {
      std::uint32_t value = 0;
      for (int byte = 0; byte < bytes; ++byte)
        value |=
            static_cast<std::uint32_t>(static_cast<unsigned char>(from_[static_cast<std::size_t>(byte) * rows_ + i]))
            << (8 * byte);
      take(i, value);
    }
    from_.remove_prefix(static_cast<std::size_t>(bytes) * rows_);
  }

 private:
  std::string* to_ = nullptr;
  std::string_view from_;
  const std::size_t rows_;
};

}  // namespace

bool operator<(const TilePoint& a, const TilePoint& b) { return tied(a) < tied(b); }
bool operator==(const TilePoint& a, const TilePoint& b) { return tied(a) == tied(b); }

TilePoint toTilePoint(const MapPoint& point, double voxel) {
  const auto steps = [&](int axis) {
    return static_cast<std::int32_t>(std::floor(static_cast<double>(point.p(axis)) * kVoxelSteps / voxel));
  };
  TilePoint stored;
  stored.x = steps(0);
  stored.y = steps(1);
  stored.z = std::clamp(steps(2), kLowestZ, -kLowestZ - 1);
  stored.red = point.red;
  stored.green = point.green;
  stored.blue = point.blue;
  stored.reflectance = point.intensity;
  stored.sensor = point.laser;
  stored.sigma = static_cast<std::uint8_t>(std::lround(std::clamp(point.sigma / kSigmaStep, 0.0F, 255.0F)));
  return stored;
}

Eigen::Vector3d tilePlace(const TilePoint& point, double voxel) {
  return (Eigen::Vector3d(point.x, point.y, point.z).array() + 0.5) * (voxel / kVoxelSteps);
}

Tile finestTile(const TilePoint& point) { return {point.x >> kTileShift, point.y >> kTileShift}; }

std::string toString(const LevelTile& tile) { return std::to_string(tile.level) + "/" + toString(tile.tile); }

std::optional<LevelTile> parseLevelTile(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto level = urban_nav_core::parseInteger(text.substr(0, slash));
  const auto tile = parseTile(text.substr(slash + 1));
  if (!level || *level < 0 || *level > kCoarsestLevel || !tile) return std::nullopt;
  return LevelTile{static_cast<int>(*level), *tile};
}

LevelTile coveringTile(const Tile& finest, int level) { return {level, {finest.x >> level, finest.y >> level}}; }

std::string printTile(const LevelTile& tile, const std::vector<TilePoint>& points) {
  std::string bytes;
  bytes.reserve(kTilePointBytes * points.size());
  const std::int32_t x = tileCorner(tile.tile.x, tile.level), y = tileCorner(tile.tile.y, tile.level);
  Columns columns(bytes, points.size());
  columns.append(3, [&](std::size_t i) { return points[i].x - x; });
  columns.append(3, [&](std::size_t i) { return points[i].y - y; });
  columns.append(3, [&](std::size_t i) { return points[i].z - kLowestZ; });
  columns.append(3, [&](std::size_t i) { return points[i].pose; });
  columns.append(2, [&](std::size_t i) { return points[i].session; });
  for (const auto member : {&TilePoint::red, &TilePoint::green, &TilePoint::blue, &TilePoint::reflectance,
                            &TilePoint::sensor, &TilePoint::sigma})
    columns.append(1, [&](std::size_t i) { return points[i].*member; });
  return bytes;
}

std::optional<std::vector<TilePoint>> readTile(const LevelTile& tile, std::string_view bytes) {
  if (bytes.size() % kTilePointBytes != 0) return std::nullopt;
  std::vector<TilePoint> points(bytes.size() / kTilePointBytes);
  const std::int32_t x = tileCorner(tile.tile.x, tile.level), y = tileCorner(tile.tile.y, tile.level);
  Columns columns(bytes, points.size());
  using Value = std::uint32_t;
  const auto number = [](Value v) { return static_cast<std::int32_t>(v); };
  columns.read(3, [&](std::size_t i, Value v) { points[i].x = x + number(v); });
  columns.read(3, [&](std::size_t i, Value v) { points[i].y = y + number(v); });
  columns.read(3, [&](std::size_t i, Value v) { points[i].z = number(v) + kLowestZ; });
  columns.read(3, [&](std::size_t i, Value v) { points[i].pose = v; });
  columns.read(2, [&](std::size_t i, Value v) { points[i].session = static_cast<std::uint16_t>(v); });
  for (const auto member : {&TilePoint::red, &TilePoint::green, &TilePoint::blue, &TilePoint::reflectance,
                            &TilePoint::sensor, &TilePoint::sigma})
    columns.read(1, [&](std::size_t i, Value v) { points[i].*member = static_cast<std::uint8_t>(v); });
  const std::int32_t width = tileCorner(1, tile.level);
  for (const TilePoint& point : points)
    if (point.x - x >= width || point.y - y >= width) return std::nullopt;
  return points;
}

}  // namespace laser_mapper
