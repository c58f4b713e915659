// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/removed_names.hpp"

#include <map>

namespace urban_nav_core {

std::string findReplacement(const std::string& full_name) {
  static const char* const kMarginalization =
      "poses and landmarks that leave the window are always marginalised; the program swf_vo-bench-plain measures "
      "odometry that deletes them";
  static const char* const kFirstEstimates = "blocks touched by the prior are always linearised at first estimates";
  static const std::map<std::string, std::string> replacements = {
      {"swf_vo.marginalization", kMarginalization},
      {"swf_vo.forget", kMarginalization},
      {"swf_vo.first_estimate_jacobians", kFirstEstimates},
      {"swf_vo.linearise", kFirstEstimates},
      {"swf_vo.subpixel", "corners are always placed to subpixels"},
  };
  const auto found = replacements.find(full_name);
  return found == replacements.end() ? "" : found->second;
}

}  // namespace urban_nav_core
