// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "laser_mapper/layers/raster.hpp"

namespace urban_nav {

/// Place of an image in a coordinate system, its first row in the north.
struct ImagePlacement {
  int width = 0, height = 0;       ///< px
  double west = 0.0, north = 0.0;  ///< m, outer corner of the first pixel
  double pixel = 0.1;              ///< m
  int epsg = 0;                    ///< code of the projected system; 0: axes of the frame map
  std::string crs = {};            ///< its name
};

/// Write GeoTIFF files (OGC 19-008r4, GeoTIFF 1.1): pixels are areas, compressed by Deflate; BigTIFF above 2 GB. The
/// same image gives the same bytes. A file is written completely or not at all. Throw UserError naming the path if it
/// cannot be written, or if the code of the system does not fit into the format.
///
/// `rgba`: red, green, blue and alpha (not premultiplied) in a byte each.
void writeGeoTiff(const std::string& path, const ImagePlacement& placement, const std::vector<std::uint8_t>& rgba);
/// `rows`: floats, rows from the north; laser_mapper::kNoValue is declared as no data. `layer`, `unit`: for the user of
/// the file, "elevation", "m".
void writeGeoTiff(const std::string& path, const ImagePlacement& placement, const std::vector<float>& rows,
                  const std::string& layer, const std::string& unit);

}  // namespace urban_nav
