// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Time span of a bag.
struct BagExtent {
  using Span = std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs>;  ///< ns; of the first and last message

  std::string path;
  Span receipts = {};
  Span span = {};                      ///< by the stamps of the images, else of receipt
  std::map<std::string, Span> images;  ///< of each topic of images, as `span`
  bool by_stamps = false;
  std::size_t messages = 0;
};

/// Returns whether two bags have the same messages, as a bag and its copy, also with another compression: equal numbers
/// and times, and equal bytes of the first and last image of each topic.
bool isSameRecording(const BagExtent& a, const BagExtent& b);

/// Returns the extents of bags in the order of their begin. Uses stamps, which are also valid for bags converted at the
/// same time; if the images of any bag have no stamps, or it has no images, all use times of receipt, since the two
/// cannot be compared. Throws DataError for a bag that cannot be read.
std::vector<BagExtent> findExtents(const std::vector<std::string>& paths);

/// Groups bags into recordings, in the order of their begin: bags less than 5 s apart are one recording, unless both
/// have images of the same topic at the same time, which one robot cannot have recorded.
std::vector<std::vector<BagExtent>> separateRecordings(const std::vector<BagExtent>& bags);

}  // namespace urban_nav_input
