// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tile_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laser_mapper/sensors.hpp"

namespace laser_mapper {

using urban_nav_core::StampNs;

namespace {

constexpr float kLidarWeight = 0.09F;      // weight of a beam with 2 cm sigma relative to 6 mm
constexpr float kUnitWeightSigma = 0.01F;  // m: standard deviation of a stereo point with weight 1

/// Returns the weight of one beam of a cell in the means of a voxel.
float beamWeight(const MapCell& cell) {
  if (isOfImages(cell.laser)) {
    const float sigma = std::max(cell.range, 1e-3F);
    return kUnitWeightSigma * kUnitWeightSigma / (sigma * sigma);
  }
  return isLidar(cell.laser) ? kLidarWeight : 1.0F;
}

}  // namespace

void TileMerger::elect(MergedCell& cell, const PassVotes& votes) {
  cell.session = votes.session;
  cell.pass = votes.pass;
  cell.laser = votes.laser;
  cell.stamp =
      votes.since + static_cast<StampNs>(std::llround(1e3 * votes.time / static_cast<double>(votes.count))) * 1000;
}

void TileMerger::add(const CellSource& source, const std::vector<MapCell>& cells, Kind kind) {
  if (kind == Kind::Lasers && cells_.size() + cells.size() > cells_.capacity()) {
    const std::size_t room = std::max(2 * cells_.capacity(), cells_.size() + cells.size());
    cells_.reserve(room);
    votes_.reserve(room);
    best_.reserve(room);
    weights_.reserve(room);
  }
  for (const MapCell& from : cells) {
    if (isOfImages(from.laser) != (kind == Kind::Stereo)) continue;
    if (from.is_ghost) {
      ghost_beams_ += from.count;
      continue;
    }
    const std::uint32_t number = table_.insert(urban_nav_registration::toKey(from.cell));
    if (number == cells_.size()) {
      cells_.emplace_back();
      cells_.back().cell = from.cell;
      votes_.emplace_back();
      best_.push_back(0.0F);
      weights_.push_back(0.0F);
    }
    MergedCell& cell = cells_[number];
    const auto count = static_cast<float>(from.count);
    const float weight = count * beamWeight(from);
    cell.count += count;
    weights_[number] += weight;
    const float share = weight / weights_[number];
    cell.offset += share * (from.offset - cell.offset);
    cell.to_laser += share * (from.to_laser - cell.to_laser);
    cell.range += share * (from.range - cell.range);
    cell.intensity += share * (static_cast<float>(from.intensity) - cell.intensity);
    PassVotes& votes = votes_[number];
    if (votes.count == 0.0F || votes.pass != source.pass || votes.session != source.session)
      votes = {source.session, source.pass, from.laser, 0.0F, 0.0, source.begin};
    votes.count += count;
    votes.time += static_cast<double>(count) *
                  (1e-3 * static_cast<double>(from.time_us) + 1e-6 * static_cast<double>(source.begin - votes.since));
    if (votes.count > best_[number]) {
      best_[number] = votes.count;
      elect(cell, votes);
    }
  }
}

std::vector<MergedCell> TileMerger::take() {
  table_ = urban_nav_registration::CellTable(1 << 12);
  votes_.clear();
  ghost_beams_ = 0;
  best_.clear();
  weights_.clear();
  return std::exchange(cells_, {});
}

}  // namespace laser_mapper
