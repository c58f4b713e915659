// SPDX-License-Identifier: BSD-3-Clause
#include "error_model.hpp"

#include <algorithm>
#include <cmath>

namespace laser_odometry {
namespace {

constexpr double kBlock = 4.0;                  // m: size of surfaces with common errors
constexpr double kApart = 1e6;                  // m, between the blocks of different orientations
constexpr double kMemory = 20.0;                // sweeps
constexpr double kLeast = 0.02;                 // lower limit of both factors
constexpr double kEndFloor = 5e-4;              // m
constexpr double kEndTurnFloor = 6e-5;          // rad: 0.03 deg, elevation error of a ring, averaged over 64 rings
constexpr double kDriftFloor = 2e-4;            // of the length: 0.02 %, a tenth of the range scale error stated by
                                                // manufacturers
constexpr double kDriftTurnFloor = 2e-5;        // rad/m
constexpr std::size_t kFewest = 30;             // cells measured in two sweeps, required for a comparison
constexpr std::size_t kFewestPlanarCells = 15;  // of planar motion, with half as many coordinates

/// Matches of one sweep in a cell.
struct CellSum {
  MapCell* cell = nullptr;
  double weight = 0.0, residual = 0.0;  // sum of weights, of weight times residual
  Vector3d p = Vector3d::Zero();
};

struct BlockSum {
  double now = 0.0, before = 0.0, change = 0.0;  // sums of weight times residual
};

std::vector<CellSum> sumByCell(const std::vector<PatchMatch>& matches) {
  std::vector<CellSum> sums;
  urban_nav_registration::CellTable table(matches.size() + 16);
  for (const PatchMatch& match : matches) {
    // Cells of different levels differ in centre or size; the address identifies a cell.
    const auto address = reinterpret_cast<std::uintptr_t>(match.cell);
    const std::uint32_t number = table.insert(static_cast<std::uint64_t>(address));
    if (number == sums.size()) sums.push_back({match.cell, 0.0, 0.0, match.p_odom});
    const double weight = match.row.weight * match.robust;
    sums[number].weight += weight;
    sums[number].residual += weight * match.residual;
  }
  return sums;
}

/// Returns the key of the block and orientation of a patch: blocks of other orientations are displaced.
std::uint64_t blockKey(const Vector3d& p, const Vector3d& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return findKey(p + Vector3d(axis * kApart, 0.0, 0.0), kBlock).value_or(1);
}

}  // namespace

void ErrorModel::observe(const std::vector<PatchMatch>& matches, std::int32_t sweep) {
  const std::vector<CellSum> sums = sumByCell(matches);
  std::vector<BlockSum> blocks;
  urban_nav_registration::CellTable table(sums.size() + 16);
  double weights = 0.0, ages = 0.0, compared = 0.0;
  std::size_t pairs = 0;
  for (const CellSum& sum : sums) {
    if (!(sum.weight > 0.0)) continue;
    MapCell& cell = *sum.cell;
    weights += sum.weight;
    ages += sum.weight * (sweep - cell.first_sweep);
    const double mean = sum.residual / sum.weight;
    if (cell.residual_sweep == sweep - 1) {
      const std::uint32_t number = table.insert(blockKey(sum.p, cell.plane.normal));
      if (number == blocks.size()) blocks.emplace_back();
      BlockSum& block = blocks[number];
      block.now += sum.weight * mean;
      block.before += sum.weight * cell.residual;
      block.change += sum.weight * (mean - cell.residual);
      compared += sum.weight;
      ++pairs;
    }
    cell.residual = mean;
    cell.residual_sweep = sweep;
  }
  if (weights > 0.0) age_ = std::max(1.0, ages / weights);
  if (pairs < (space_ == MotionSpace::Planar ? kFewestPlanarCells : kFewest)) return;
  double passing = 0.0, lasting = 0.0;
  for (const BlockSum& block : blocks) {
    passing += 0.5 * block.change * block.change;
    lasting += block.now * block.before;
  }
  observed_ = std::min(observed_ + 1, static_cast<std::int32_t>(kMemory));
  const double gain = 1.0 / observed_;
  passing_ += gain * (passing / compared - passing_);
  lasting_ += gain * (lasting / compared - lasting_);
  passing_ = std::max(passing_, kLeast);
  lasting_ = std::max(lasting_, kLeast);
}

Matrix6d ErrorModel::endFloor() {
  Matrix6d C = Matrix6d::Zero();
  C.topLeftCorner<3, 3>().diagonal().setConstant(kEndFloor * kEndFloor);
  C.bottomRightCorner<3, 3>().diagonal().setConstant(kEndTurnFloor * kEndTurnFloor);
  return C;
}

Matrix6d ErrorModel::driftFloor(double length) {
  const double shift = kDriftFloor * length + 1e-5, turn = kDriftTurnFloor * length + 1e-6;
  Matrix6d C = Matrix6d::Zero();
  C.topLeftCorner<3, 3>().diagonal().setConstant(shift * shift);
  C.bottomRightCorner<3, 3>().diagonal().setConstant(turn * turn);
  return C;
}

void ErrorModel::archive(urban_nav_core::Archive& archive) {
  archive(passing_, lasting_, age_, observed_);
  archive.require(passing_ > 0.0 && lasting_ > 0.0 && age_ >= 1.0 && observed_ >= 0, "error factors out of range");
}

}  // namespace laser_odometry
