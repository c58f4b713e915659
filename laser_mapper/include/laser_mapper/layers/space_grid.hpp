// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "laser_mapper/occupancy_grid.hpp"

namespace laser_mapper {

/// State of a cube of space.
enum class SpaceState : std::uint8_t { Unknown, Free, Occupied };

/// Space of a map in cubes: occupied where points of the map are, free where beams to points of the map passed, unknown
/// elsewhere. Points on moving objects are not in the map (Parameters::ghosts), so that these leave free space. Memory:
/// two bits per cube of the blocks of 16^3 cubes that beams touched. Not thread-safe.
class SpaceGrid {
 public:
  using Index = std::array<int, 3>;  ///< of a cube or a block; number 0 begins at the origin of the map

  /// Cubes of 16^3.
  class Block {
   public:
    static constexpr int kEdge = 16;  ///< cubes
    /// `cube`: of this block, in the numbers of all cubes.
    SpaceState at(const Index& cube) const {
      const std::size_t i = number(cube);
      return static_cast<SpaceState>((bits_[i / 4] >> (2 * (i % 4))) & 3U);
    }
    void set(const Index& cube, SpaceState state) {
      const std::size_t i = number(cube), shift = 2 * (i % 4);
      bits_[i / 4] =
          static_cast<std::uint8_t>((bits_[i / 4] & ~(3U << shift)) | (static_cast<unsigned>(state) << shift));
    }

   private:
    static std::size_t number(const Index& cube) {
      const auto within = [](int index) { return static_cast<std::size_t>(index & (kEdge - 1)); };
      return within(cube[0]) + kEdge * (within(cube[1]) + kEdge * within(cube[2]));
    }
    std::array<std::uint8_t, kEdge * kEdge * kEdge / 4> bits_{};
  };

  /// `resolution`: edge of the cubes, m.
  explicit SpaceGrid(double resolution) : resolution_(resolution) {}

  /// Adds points of the map, each with the beam to it. Beams that begin in the same cubes of 0.5 m and end in the same
  /// cube pass the same space and are followed once. `origin`: nullopt if the beam of a point does not imply free
  /// space.
  void add(const std::vector<MapPoint>& points, const BeamOrigin& origin);

  SpaceState at(const Eigen::Vector3d& p) const;
  double resolution() const { return resolution_; }
  /// Returns the blocks with known cubes by their index.
  const std::map<Index, Block>& blocks() const { return blocks_; }

 private:
  Index cubeAt(const Eigen::Vector3d& p) const;
  Block& blockAt(const Index& cube);
  void followBeam(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  const double resolution_;
  std::map<Index, Block> blocks_;
  std::pair<Index, Block*> last_{{0, 0, 0}, nullptr};  ///< block that was used last
  std::set<std::pair<Index, Index>> followed_;         ///< ends and origins of beams of these points
};

}  // namespace laser_mapper
