// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_options.hpp"

#include <algorithm>

namespace urban_nav {

bool isRequested(const MapOptions& options, const std::string& stage) {
  return options.stages.empty() ||
         std::find(options.stages.begin(), options.stages.end(), stage) != options.stages.end();
}

}  // namespace urban_nav
