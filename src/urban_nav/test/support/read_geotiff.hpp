// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tiffio.h>
#undef COMPRESSION_NONE  // also a constant of rosbag

#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace urban_nav {

/// A GeoTIFF as read by libtiff and OpenCV.
struct ReadGeoTiff {
  double west = 0.0, north = 0.0, pixel = 0.0;
  int epsg = 0;  ///< 0: none
  cv::Mat image;

  /// Returns the pixel at a position; {-1, -1} outside.
  cv::Point at(double x, double y) const {
    const cv::Point p(static_cast<int>(std::floor((x - west) / pixel)),
                      static_cast<int>(std::floor((north - y) / pixel)));
    return p.x >= 0 && p.y >= 0 && p.x < image.cols && p.y < image.rows ? p : cv::Point(-1, -1);
  }
};

inline ReadGeoTiff readGeoTiff(const std::string& path) {
  ReadGeoTiff read;
  TIFFSetWarningHandler(nullptr);  // about tags that libtiff does not know
  const std::unique_ptr<TIFF, void (*)(TIFF*)> file(TIFFOpen(path.c_str(), "r"), TIFFClose);
  if (!file) return read;
  std::uint32_t count = 0;
  const double* values = nullptr;
  if (TIFFGetField(file.get(), 33550, &count, &values) == 1 && count == 3) read.pixel = values[0];
  if (TIFFGetField(file.get(), 33922, &count, &values) == 1 && count == 6) {
    read.west = values[3];
    read.north = values[4];
  }
  const std::uint16_t* keys = nullptr;
  if (TIFFGetField(file.get(), 34735, &count, &keys) == 1)
    for (std::uint32_t i = 4; i + 3 < count; i += 4)
      if (keys[i] == 3072) read.epsg = keys[i + 3];
  read.image = cv::imread(path, cv::IMREAD_UNCHANGED);
  return read;
}

}  // namespace urban_nav
