// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/bag_checkpoint.hpp"

#include <algorithm>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav {

namespace {

constexpr const char* kName = "map at the end of a bag";
constexpr std::uint32_t kVersion = 1;

void members(urban_nav_core::Archive& archive, BagState& state) {
  archive(state.bags, state.receipt, state.reader, state.vo);
}

}  // namespace

std::string packBagState(BagState state) {
  urban_nav_core::Archive archive;
  members(archive, state);
  return urban_nav_core::seal(kName, kVersion, archive.take());
}

BagState unpackBagState(std::string_view bytes) {
  urban_nav_core::Archive archive(urban_nav_core::unseal(kName, kVersion, bytes), std::string("state of ") + kName);
  BagState state;
  members(archive, state);
  archive.finish();
  return state;
}

std::optional<std::size_t> bagsBehind(const BagState& state, const std::vector<std::string>& bags,
                                      urban_nav_core::StampNs begin) {
  for (std::size_t same = std::min(state.bags.size(), bags.size()); same > 0; --same)
    if (std::equal(bags.begin(), bags.begin() + static_cast<std::ptrdiff_t>(same),
                   state.bags.end() - static_cast<std::ptrdiff_t>(same)))
      return same;
  const double gap = urban_nav_core::secondsBetween(state.receipt, begin);
  if (bags.empty() || !(gap > 0.0) || gap >= kLongestSplit) return std::nullopt;
  return 0;
}

}  // namespace urban_nav
