// SPDX-License-Identifier: BSD-3-Clause
#include "chunk_store.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "laser_mapper/laser_map.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"

namespace laser_mapper {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_store::MapChunk;
using urban_nav_store::MapChunkCells;

namespace {

constexpr StampNs kPoseSpacing = 500'000'000;
constexpr double kLever = 10.0;         // m, typical distance of a chunk's points from the robot
constexpr std::size_t kPoseBytes = 64;  // a stamp and seven numbers

void appendStampedPose(std::string& bytes, StampNs stamp, const Pose& pose) {
  urban_nav_store::appendInteger(bytes, static_cast<std::uint64_t>(stamp));
  for (int i = 0; i < 3; ++i) urban_nav_store::appendNumber(bytes, pose.t()(i));
  for (int i = 0; i < 4; ++i) urban_nav_store::appendNumber(bytes, pose.q().coeffs()(i));
}

}  // namespace

std::vector<Tile> chunkTiles(const MapChunk& chunk) {
  std::vector<Tile> tiles;
  std::istringstream words(chunk.tiles);
  for (std::string word; words >> word;)
    if (const auto tile = parseTile(word)) tiles.push_back(*tile);
  return tiles;
}

std::map<StampNs, MapChunk> ChunkStore::chunks() const {
  std::map<StampNs, MapChunk> all;
  chunks_.forEach(session_, [&](const MapChunk& chunk) { all[chunk.begin] = chunk; });
  return all;
}

PackedPart packPart(const Tile& tile, const std::vector<MapCell>& cells) {
  return {tile, static_cast<std::int64_t>(cells.size()), packCells(tile, cells)};
}

void ChunkStore::put(MapChunk header, std::vector<PackedPart> parts, const MapChunk* old) {
  if (old != nullptr) remove(*old);
  header.session = session_;
  header.revision = old != nullptr ? old->revision + 1 : 1;
  header.tiles.clear();
  header.cells = 0;
  for (PackedPart& part : parts) {
    header.tiles += (header.tiles.empty() ? "" : " ") + toString(part.tile);
    header.cells += part.cells;
    putCells(header.begin, std::move(part));
  }
  chunks_.put(header);
}

void ChunkStore::putCells(StampNs begin, PackedPart part) {
  cells_.put({session_, toString(part.tile), begin, part.cells, std::move(part.data)});
}

void ChunkStore::remove(const MapChunk& chunk) {
  for (const Tile& tile : chunkTiles(chunk)) cells_.remove({session_, toString(tile), chunk.begin, 0, {}});
  chunks_.remove(chunk);
}

void forgetChunks(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  ChunkStore chunks(store, session);
  for (const auto& [begin, chunk] : chunks.chunks()) chunks.remove(chunk);
}

void ChunkStore::forEachInTile(const Tile& tile, const std::function<void(StampNs, std::string)>& take) const {
  const MapChunkCells key{session_, toString(tile), 0, 0, {}};
  cells_.forEachBetween(key, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(),
                        [&](const MapChunkCells& row) { take(row.begin, row.data); });
}

std::string packChunkPoses(const Trajectory& T_map_base, StampNs begin, StampNs max_gap) {
  std::string bytes;
  for (StampNs stamp = begin; stamp <= begin + kChunkNs; stamp += kPoseSpacing)
    if (const auto pose = T_map_base.at(stamp, max_gap)) appendStampedPose(bytes, stamp, *pose);
  // At a begin or end of the trajectory within the chunk, the number of beams with a pose may have changed.
  for (const urban_nav_core::StampedPose* end : {&T_map_base.front(), &T_map_base.back()})
    if (end->stamp > begin && end->stamp < begin + kChunkNs) appendStampedPose(bytes, end->stamp, end->pose);
  return bytes;
}

double chunkShift(const std::string& packed, const Trajectory& T_map_base, StampNs begin, StampNs max_gap) {
  constexpr double kOther = std::numeric_limits<double>::infinity();
  const std::string now = packChunkPoses(T_map_base, begin, max_gap);
  if (now.size() != packed.size() || now.size() % kPoseBytes != 0) return kOther;
  urban_nav_store::ByteReader before(packed), after(now);
  const auto readPose = [](urban_nav_store::ByteReader& reader) {
    double value[7];
    for (double& each : value) each = reader.number();
    return Pose(Eigen::Quaterniond(value[6], value[3], value[4], value[5]),
                Eigen::Vector3d(value[0], value[1], value[2]));
  };
  double largest = 0.0;
  while (after.left() > 0) {
    if (before.integer() != after.integer()) return kOther;
    const Pose a = readPose(before), b = readPose(after);
    largest = std::max(largest, distanceBetween(a, b) + kLever * angleBetween(a, b));
  }
  return largest;
}

std::string renderSettings(const Parameters& parameters, const std::vector<MountedLaser>& lasers) {
  std::string text = "2";  // version of this encoding
  for (const double value :
       {parameters.voxel, parameters.min_range, parameters.max_range, parameters.range_sigma, parameters.max_gap,
        parameters.mixed_pixels ? 1.0 : 0.0, parameters.ghosts ? parameters.ghost_gap : 0.0,
        parameters.stereo ? parameters.stereo_sigma : 0.0})
    urban_nav_store::appendNumber(text, value);
  for (const MountedLaser& laser : lasers) {
    urban_nav_store::appendText(text, laser.frame);
    appendStampedPose(text, laser.delay, laser.T_base_laser);
  }
  return urban_nav_store::sha256(text);
}

}  // namespace laser_mapper
