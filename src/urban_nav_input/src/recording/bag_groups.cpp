// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_groups.hpp"

#include <algorithm>

namespace urban_nav_input {

std::vector<BagGroup> groupBags(Recording& recording) {
  std::vector<BagGroup> groups;
  std::size_t count = 0;
  for (RecordingFile* bag : recording.files()) {
    const MessageSelection all({bag}, std::nullopt, {});
    const bool empty = all.size() == 0;
    if (groups.empty() || (!empty && all.first() > groups.back().receipt)) groups.emplace_back();
    BagGroup& group = groups.back();
    group.bags.push_back(bag);
    group.end = ++count;
    if (!empty) group.receipt = std::max(group.receipt, all.last());
  }
  return groups;
}

std::vector<BagGroup> asOneGroup(const std::vector<BagGroup>& groups) {
  BagGroup all;
  for (const BagGroup& group : groups) {
    all.bags.insert(all.bags.end(), group.bags.begin(), group.bags.end());
    all.end = group.end;
    all.receipt = std::max(all.receipt, group.receipt);
  }
  return {all};
}

}  // namespace urban_nav_input
