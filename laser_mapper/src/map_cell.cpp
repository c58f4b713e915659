// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_cell.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace laser_mapper {

using urban_nav_store::ByteReader;

namespace {

constexpr std::size_t kMaxCellBytes = std::size_t{1} << 28;
constexpr std::size_t kCellBytes = 23;
constexpr std::uint32_t kGhostBit = 128;  // in the byte of the sensor
constexpr int kOffsetSteps = 65535;       // per voxel edge
constexpr float kRangeStep = 1e-3F;       // m
constexpr float kDirectionStep = 127;     // per unit

int floorDivide(int value, int by) { return value >= 0 ? value / by : -((-value + by - 1) / by); }

std::uint32_t quantise(float value, float per_unit, std::uint32_t largest) {
  return static_cast<std::uint32_t>(std::clamp(std::round(value * per_unit), 0.0F, static_cast<float>(largest)));
}

/// Writes small numbers by column: bytes of equal significance are contiguous, which compresses best.
class ByteColumns {
 public:
  explicit ByteColumns(std::size_t rows) : rows_(rows) {}

  template <typename Value>
  void append(std::string& out, int bytes, const Value& value) const {
    for (int byte = 0; byte < bytes; ++byte)
      for (std::size_t i = 0; i < rows_; ++i) out.push_back(static_cast<char>(value(i) >> (8 * byte) & 0xffU));
  }

  template <typename Take>
  void read(std::string_view& from, int bytes, const Take& take) const {
    for (std::size_t i = 0; i < rows_; ++i) {
      std::uint32_t value = 0;
      for (int byte = 0; byte < bytes; ++byte)
        value |=
            static_cast<std::uint32_t>(static_cast<unsigned char>(from[static_cast<std::size_t>(byte) * rows_ + i]))
            << (8 * byte);
      take(i, value);
    }
    from.remove_prefix(static_cast<std::size_t>(bytes) * rows_);
  }

 private:
  std::size_t rows_;
};

}  // namespace

Tile tileAt(const Cell& cell) { return {floorDivide(cell.x, kTileCells), floorDivide(cell.y, kTileCells)}; }

std::string toString(const Tile& tile) { return std::to_string(tile.x) + "," + std::to_string(tile.y); }

std::optional<Tile> parseTile(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto x = urban_nav_core::parseInteger(text.substr(0, comma));
  const auto y = urban_nav_core::parseInteger(text.substr(comma + 1));
  if (!x || !y || std::abs(*x) > (1 << 20) || std::abs(*y) > (1 << 20)) return std::nullopt;
  return Tile{static_cast<int>(*x), static_cast<int>(*y)};
}

std::string packCells(const Tile& tile, const std::vector<MapCell>& cells) {
  std::string bytes;
  bytes.reserve(8 + kCellBytes * cells.size());
  urban_nav_store::appendInteger(bytes, cells.size());
  const ByteColumns columns(cells.size());
  const auto inTile = [](int cell, int tile_index) {
    return static_cast<std::uint32_t>(cell - tile_index * kTileCells);
  };
  columns.append(bytes, 1, [&](std::size_t i) { return inTile(cells[i].cell.x, tile.x); });
  columns.append(bytes, 1, [&](std::size_t i) { return inTile(cells[i].cell.y, tile.y); });
  columns.append(bytes, 2,
                 [&](std::size_t i) { return static_cast<std::uint32_t>(cells[i].cell.z + kMaxHeightCell + 1); });
  columns.append(bytes, 2, [&](std::size_t i) { return std::uint32_t{cells[i].count}; });
  columns.append(bytes, 1,
                 [&](std::size_t i) { return std::uint32_t{cells[i].laser} | (cells[i].is_ghost ? kGhostBit : 0U); });
  columns.append(bytes, 1, [&](std::size_t i) { return std::uint32_t{cells[i].intensity}; });
  for (int axis = 0; axis < 3; ++axis)
    columns.append(bytes, 2,
                   [&](std::size_t i) { return quantise(cells[i].offset[axis], kOffsetSteps, kOffsetSteps); });
  for (int axis = 0; axis < 3; ++axis)
    columns.append(bytes, 1, [&](std::size_t i) {
      return static_cast<std::uint32_t>(static_cast<int>(std::lround(cells[i].to_laser[axis] * kDirectionStep)) + 128);
    });
  columns.append(bytes, 2, [&](std::size_t i) { return quantise(cells[i].range, 1.0F / kRangeStep, 65535); });
  columns.append(bytes, 4, [&](std::size_t i) { return static_cast<std::uint32_t>(cells[i].time_us); });
  return urban_nav_store::deflated(bytes);
}

std::optional<std::vector<MapCell>> unpackCells(const Tile& tile, std::string_view packed) {
  const std::optional<std::string> bytes = urban_nav_store::inflated(packed, kMaxCellBytes);
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  const std::uint64_t count = reader.integer();
  if (!reader.ok() || reader.left() % kCellBytes != 0 || count != reader.left() / kCellBytes) return std::nullopt;
  std::vector<MapCell> cells(static_cast<std::size_t>(count));
  std::string_view rest = std::string_view(*bytes).substr(bytes->size() - reader.left());
  const ByteColumns columns(cells.size());
  using Value = std::uint32_t;
  columns.read(rest, 1, [&](std::size_t i, Value v) { cells[i].cell.x = static_cast<int>(v) + tile.x * kTileCells; });
  columns.read(rest, 1, [&](std::size_t i, Value v) { cells[i].cell.y = static_cast<int>(v) + tile.y * kTileCells; });
  columns.read(rest, 2, [&](std::size_t i, Value v) { cells[i].cell.z = static_cast<int>(v) - kMaxHeightCell - 1; });
  columns.read(rest, 2, [&](std::size_t i, Value v) { cells[i].count = static_cast<std::uint16_t>(v); });
  columns.read(rest, 1, [&](std::size_t i, Value v) {
    cells[i].laser = static_cast<std::uint8_t>(v & ~kGhostBit);
    cells[i].is_ghost = (v & kGhostBit) != 0;
  });
  columns.read(rest, 1, [&](std::size_t i, Value v) { cells[i].intensity = static_cast<std::uint8_t>(v); });
  for (int axis = 0; axis < 3; ++axis)
    columns.read(rest, 2, [&](std::size_t i, Value v) {
      cells[i].offset[axis] = static_cast<float>(v) / static_cast<float>(kOffsetSteps);
    });
  for (int axis = 0; axis < 3; ++axis)
    columns.read(rest, 1, [&](std::size_t i, Value v) {
      cells[i].to_laser[axis] = static_cast<float>(static_cast<int>(v) - 128) / kDirectionStep;
    });
  columns.read(rest, 2, [&](std::size_t i, Value v) { cells[i].range = kRangeStep * static_cast<float>(v); });
  columns.read(rest, 4, [&](std::size_t i, Value v) { cells[i].time_us = static_cast<std::int32_t>(v); });
  for (const MapCell& cell : cells)
    if (cell.count == 0) return std::nullopt;
  return cells;
}

}  // namespace laser_mapper
