// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_registration {

/// A cube of a grid by its integer coordinates.
struct Cell {
  int x = 0, y = 0, z = 0;
};

/// Cells beyond this distance from the origin have no key: 260 km for cells of 0.25 m.
constexpr int kFarthestCell = (1 << 20) - 2;

/// Returns the cell of a point for an edge length of 1 / `per_m`. Requires a point within the grid.
inline Cell toCell(const Eigen::Vector3f& point, float per_m) {
  return {static_cast<int>(std::floor(point.x() * per_m)), static_cast<int>(std::floor(point.y() * per_m)),
          static_cast<int>(std::floor(point.z() * per_m))};
}

/// Returns the key of a cell: unique within kFarthestCell + 1 and not 0.
inline std::uint64_t toKey(const Cell& cell) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)); };
  return part(cell.x) | part(cell.y) << 21U | part(cell.z) << 42U;
}

/// Returns the key of the cell at `offset` from that of `key`.
inline std::uint64_t keyBeside(std::uint64_t key, const Cell& offset) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(i)); };
  return key + part(offset.x) + (part(offset.y) << 21U) + (part(offset.z) << 42U);
}

/// Maps cells to numbers 0, 1, 2, ... in order of insertion. Open addressing: a look-up is one or two reads.
class CellTable {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  explicit CellTable(std::size_t expected) { rehash(expected); }

  std::size_t size() const { return size_; }
  /// Returns the number of a cell, or `kNone`.
  std::uint32_t find(std::uint64_t key) const {
    for (std::size_t at = findSlot(key);; at = (at + 1) & mask_) {
      if (slots_[at].key == key) return slots_[at].number;
      if (slots_[at].key == 0) return kNone;
    }
  }
  /// Returns the number of a cell; a new cell gets the next number.
  std::uint32_t insert(std::uint64_t key) {
    for (std::size_t at = findSlot(key);; at = (at + 1) & mask_) {
      if (slots_[at].key == key) return slots_[at].number;
      if (slots_[at].key != 0) continue;
      slots_[at] = {key, static_cast<std::uint32_t>(size_++)};
      if (3 * size_ > 2 * mask_) rehash(2 * size_);
      return static_cast<std::uint32_t>(size_ - 1);
    }
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;
  };

  std::size_t findSlot(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15U) >> shift_);
  }  // Knuth 1973, 6.4
  void rehash(std::size_t expected);

  std::vector<Slot> slots_;
  std::size_t size_ = 0, mask_ = 0;
  unsigned shift_ = 0;
};

}  // namespace urban_nav_registration
