// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav::testing {

/// The same bag, `seconds` later: stamps and times of receipt.
void delayBag(const std::string& from, const std::string& to, double seconds);

enum class Rewrite {
  Shuffle,  ///< messages in another order, each within 40 ms of its place
  WithoutTruth,
  CompressedColourUnderOtherNames,  ///< PNG in colour on /cam0/..., no camera_info, no tf
};
void rewriteBag(const std::string& from, const std::string& to, Rewrite how);

}  // namespace urban_nav::testing
