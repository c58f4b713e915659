// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace swf_vo {

/// Reserves three times `size` elements if the capacity is below `size`: sizes vary from frame to frame, and a steady
/// state should allocate nothing.
template <typename Vector>
void reserveWithHeadroom(Vector& vector, std::size_t size) {
  if (vector.capacity() < size) vector.reserve(3 * size);
}

}  // namespace swf_vo
