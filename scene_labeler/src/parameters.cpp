// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/parameters.hpp"

#include <cstdint>

namespace scene_labeler {

using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "scene_labeler",
      {
          {"superpixel", &P::superpixel, "px", std::int64_t{12}, std::int64_t{4}, std::int64_t{200}, {},
           "Edge of the superpixels, whose returns get one class.", "paper 8.1"},
      });
  return rows;
}
// clang-format on

}  // namespace scene_labeler
