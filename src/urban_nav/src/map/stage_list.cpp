// SPDX-License-Identifier: BSD-3-Clause
#include "map/stage_list.hpp"

namespace urban_nav {

std::vector<std::string> stageNames(const AllStages& stages) {
  std::vector<std::string> names;
  for (const std::unique_ptr<Stage>& stage : stages)
    if (stage->describe().listed) names.push_back(stage->describe().name);
  return names;
}

}  // namespace urban_nav
