// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/cloud/cell_table.hpp"

#include <utility>

namespace urban_nav_registration {

void CellTable::rehash(std::size_t expected) {
  unsigned bits = 6;
  while ((std::size_t{1} << bits) < 2 * expected) ++bits;
  const std::vector<Slot> old = std::move(slots_);
  slots_.assign(std::size_t{1} << bits, Slot{});
  mask_ = slots_.size() - 1;
  shift_ = 64 - bits;
  for (const Slot& slot : old) {
    if (slot.key == 0) continue;
    std::size_t at = findSlot(slot.key);
    while (slots_[at].key != 0) at = (at + 1) & mask_;
    slots_[at] = slot;
  }
}

}  // namespace urban_nav_registration
