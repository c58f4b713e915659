// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// When a bag was recorded.
struct BagExtent {
  using Span = std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs>;  ///< ns; of the first and last message

  std::string path;
  Span receipts = {};
  Span span = {};                      ///< by the stamps of the images, else of receipt
  std::map<std::string, Span> images;  ///< of each topic of images, as `span`
  bool by_stamps = false;
  std::size_t messages = 0;
};

/// Returns whether two bags hold the same messages, as a bag and its copy (also one that is compressed otherwise) do:
/// as many, of the same times, with the same bytes of the first and last image of each topic.
bool isSameRecording(const BagExtent& a, const BagExtent& b);

/// The extents of bags in the order of their begin. Stamps tell what belongs together also where bags were converted or
/// written anew, all at the same time; where the images of one bag have none, or it has no images, all are placed by
/// receipt, since the two cannot be compared. Throws DataError for a bag that cannot be read.
std::vector<BagExtent> findExtents(const std::vector<std::string>& paths);

/// Recordings that consist of some bags each, in the order of their begin: what is less than 5 s apart is one, unless
/// both bags hold images of the same topic at the same time, which one robot cannot have recorded.
std::vector<std::vector<BagExtent>> separateRecordings(const std::vector<BagExtent>& bags);

}  // namespace urban_nav_input
