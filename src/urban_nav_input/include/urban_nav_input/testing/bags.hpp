// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_input::testing {

/// The same bag, `seconds` later: stamps and times of receipt.
void delayBag(const std::string& from, const std::string& to, double seconds);

enum class Rewrite {
  Shuffle,  ///< messages in another order, each within 40 ms of its place
  WithoutTruth,
  CompressedColourUnderOtherNames,  ///< PNG in colour on /cam0/..., no camera_info, no tf
};
void rewriteBag(const std::string& from, const std::string& to, Rewrite how);

/// The same bag in parts of equal length by times of receipt, with an IMU that lies askew, wheels that turn, and
/// panoramas of five images as often as left images. What is published once (/tf_static) is in the first part alone;
/// images come up to 40 ms late, so that pairs are cut in two.
void splitBag(const std::string& from, const std::vector<std::string>& parts);

}  // namespace urban_nav_input::testing
