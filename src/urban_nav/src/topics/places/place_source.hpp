// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// Images of one place at one time: a single one, or those of a panorama in order; an empty one is missing.
struct PlaceImages {
  urban_nav_core::StampNs stamp = 0;
  std::vector<cv::Mat> grey;  ///< CV_8UC1
};

/// One session of images for place recognition, in order of time.
class PlaceSource {
 public:
  virtual ~PlaceSource() = default;
  virtual const std::string& path() const = 0;
  /// Returns the expected number of places; 0 if unknown.
  virtual std::size_t expected() const = 0;
  /// Returns the next images; nullopt at the end. Throws DataError if the input becomes unreadable.
  virtual std::optional<PlaceImages> next() = 0;
  /// Returns notes for the user: chosen topics, images that could not be read.
  virtual const std::vector<std::string>& notes() const = 0;
};

/// Opens a folder of images (in order of name; stamps from times.txt beside them in seconds, otherwise 1 s apart from
/// 0; of a stereo folder the left images) or a bag (panoramas, else the left images). `topics`: ROLE:=NAME with roles
/// panorama0 ... panorama4 and left. Throws UserError if it is neither, or has no images.
std::unique_ptr<PlaceSource> openPlaceSource(const std::string& path, const std::vector<std::string>& topics);

std::unique_ptr<PlaceSource> openPlaceFolder(const std::string& path);
std::unique_ptr<PlaceSource> openPlaceBag(const std::string& path, const std::vector<std::string>& topics);

}  // namespace urban_nav
