// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav {

/// Attributes that a stage adds to each point of an exported map. Points are numbered in the order of the map tiles.
struct PointAttributes {
  urban_nav_core::PlyLayout ply;  ///< properties after those of the map, and comments of the header
  urban_nav_core::LasAttribute las;
  std::function<void(std::size_t point, std::string& bytes)> append_ply;  ///< appends the values of `ply`
  std::function<void(std::size_t point, std::string& bytes)> append_las;  ///< appends the value of `las`
  std::function<std::uint8_t(std::size_t point)> las_classification;      ///< class of the ASPRS
};

}  // namespace urban_nav
