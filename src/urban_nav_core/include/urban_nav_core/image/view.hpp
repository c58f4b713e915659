// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace urban_nav_core {

/// Non-owning view of 8-bit grey pixels. Row-major, `stride` bytes from row to row. (0, 0) is the centre of the top
/// left pixel, u to the right, v down. Cheap to copy; must not outlive the owner of the pixels.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  const std::uint8_t* row(int v) const { return data + v * stride; }
  std::uint8_t at(int u, int v) const {
    assert(u >= 0 && v >= 0 && u < width && v < height);
    return row(v)[u];
  }
};

}  // namespace urban_nav_core
