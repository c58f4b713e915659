// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace swf_vo {

/// Sizes vary from frame to frame: room for three times what is needed lasts, so that a steady state allocates nothing.
template <typename Vector>
void makeRoom(Vector& vector, std::size_t size) {
  if (vector.capacity() < size) vector.reserve(3 * size);
}

}  // namespace swf_vo
