// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/octomap_file.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "urban_nav_core/io/numbers.hpp"

namespace laser_mapper {

namespace {

constexpr int kHalfTree = 32768;  // cubes from the corner of the tree to the origin of the map: depth 16

/// Writer of one tree. Nodes are in depth-first order; each states two bits for each of its children: 0 unknown,
/// 1 free, 2 occupied, 3 divided.
class OctreeWriter {
 public:
  explicit OctreeWriter(const SpaceGrid& space) : space_(space) {}

  OctomapText print() {
    std::vector<const BlockEntry*> all;
    for (const BlockEntry& block : space_.blocks())
      if (isInTree(block.first)) all.push_back(&block);
    std::string nodes;
    if (!all.empty()) {
      const Part root = printNode({-kHalfTree, -kHalfTree, -kHalfTree}, 2 * kHalfTree, all, nodes);
      ++text_.nodes;
      if (root != Part::Divided) nodes.clear();  // impossible: a map does not fill the tree
    }
    text_.bytes = "# Octomap OcTree binary file\n# map of urban_nav: frame map, m\nid OcTree\nsize " +
                  std::to_string(text_.nodes) + "\nres " + urban_nav_core::printNumber(space_.resolution()) +
                  "\ndata\n" + nodes;
    return std::move(text_);
  }

 private:
  using Index = SpaceGrid::Index;
  using BlockEntry = std::pair<const Index, SpaceGrid::Block>;
  enum class Part : unsigned { Unknown = 0, Free = 1, Occupied = 2, Divided = 3 };

  static bool isInTree(const Index& block) {
    for (const int index : block)
      if (index < -kHalfTree / SpaceGrid::Block::kEdge || index >= kHalfTree / SpaceGrid::Block::kEdge) return false;
    return true;
  }

  /// Returns whether a block is in the cube at `low` with an edge of at least a block.
  static bool isIn(const Index& block, const Index& low, int edge) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int cube = block[axis] * SpaceGrid::Block::kEdge;
      if (cube < low[axis] || cube >= low[axis] + edge) return false;
    }
    return true;
  }

  /// Appends the node of the cubes from `low` on, with an edge of `edge` cubes, unless it is one leaf. `blocks`: those
  /// in it.
  Part printNode(const Index& low, int edge, const std::vector<const BlockEntry*>& blocks, std::string& nodes) {
    if (blocks.empty()) return Part::Unknown;
    if (edge == 1) return static_cast<Part>(blocks.front()->second.at(low));
    std::array<Part, 8> parts{};
    std::array<std::string, 8> below;
    for (std::size_t child = 0; child < 8; ++child) {
      const int half = edge / 2;
      const Index corner{low[0] + ((child & 1U) != 0 ? half : 0), low[1] + ((child & 2U) != 0 ? half : 0),
                         low[2] + ((child & 4U) != 0 ? half : 0)};
      std::vector<const BlockEntry*> inside;
      if (half < SpaceGrid::Block::kEdge) {
        inside = blocks;
      } else {
        for (const BlockEntry* block : blocks)
          if (isIn(block->first, corner, half)) inside.push_back(block);
      }
      parts[child] = printNode(corner, half, inside, below[child]);
    }
    bool are_equal = parts[0] != Part::Divided;
    for (const Part part : parts) are_equal = are_equal && part == parts[0];
    if (are_equal) return parts[0];
    appendChildren(parts, below, nodes);
    return Part::Divided;
  }

  void appendChildren(const std::array<Part, 8>& parts, const std::array<std::string, 8>& below, std::string& nodes) {
    unsigned bits = 0;
    for (std::size_t child = 0; child < 8; ++child) {
      bits |= static_cast<unsigned>(parts[child]) << (2 * child);
      text_.nodes += parts[child] == Part::Unknown ? 0 : 1;
      text_.free += parts[child] == Part::Free ? 1 : 0;
      text_.occupied += parts[child] == Part::Occupied ? 1 : 0;
    }
    nodes += static_cast<char>(bits & 0xffU);
    nodes += static_cast<char>(bits >> 8U);
    for (const std::string& child : below) nodes += child;
  }

  const SpaceGrid& space_;
  OctomapText text_;
};

}  // namespace

OctomapText printOctomap(const SpaceGrid& space) { return OctreeWriter(space).print(); }

}  // namespace laser_mapper
