// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_input::testing {

/// Copies a bag with stamps and times of receipt `seconds` later.
void delayBag(const std::string& from, const std::string& to, double seconds);
/// Change made to a copy of a bag.
enum class Rewrite {
  Shuffle,  ///< messages in another order, each within 40 ms of its place
  WithoutTruth,
  CompressedColourUnderOtherNames,  ///< PNG in colour on /cam0/..., no camera_info, no tf
};
void rewriteBag(const std::string& from, const std::string& to, Rewrite how);

/// Copies a bag in parts of equal duration by receipt, with a tilted IMU, turning wheels, and panoramas of five images
/// at the rate of left images. Only the first part has /tf_static; images are up to 40 ms late, so that some pairs are
/// divided between parts.
void splitBag(const std::string& from, const std::vector<std::string>& parts);

}  // namespace urban_nav_input::testing
