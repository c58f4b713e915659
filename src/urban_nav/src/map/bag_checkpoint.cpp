// SPDX-License-Identifier: BSD-3-Clause
#include "map/bag_checkpoint.hpp"

#include <algorithm>
#include <filesystem>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

constexpr const char* kCheckpointName = "map at the end of a bag";
constexpr std::uint32_t kCheckpointVersion = 2;
constexpr const char* kOnlyStageOfVersion1 = "swf_vo";

void members(urban_nav_core::Archive& archive, BagCheckpoint& checkpoint) {
  archive(checkpoint.bags, checkpoint.receipt, checkpoint.reader, checkpoint.stages);
}

void membersOfVersion1(urban_nav_core::Archive& archive, BagCheckpoint& checkpoint) {
  checkpoint.stages = {{kOnlyStageOfVersion1, ""}};
  archive(checkpoint.bags, checkpoint.receipt, checkpoint.reader, checkpoint.stages.front().second);
}

BagCheckpoint unpack(std::string_view bytes, std::uint32_t version,
                     void (*members_of_version)(urban_nav_core::Archive&, BagCheckpoint&)) {
  urban_nav_core::Archive archive(urban_nav_core::unseal(kCheckpointName, version, bytes),
                                  std::string("state of ") + kCheckpointName);
  BagCheckpoint checkpoint;
  members_of_version(archive, checkpoint);
  archive.finish();
  return checkpoint;
}

}  // namespace

std::string_view BagCheckpoint::state(const std::string& key) const {
  for (const StageState& stage : stages)
    if (stage.first == key) return stage.second;
  return {};
}

bool isPartOfSplit(const std::string& bag) {
  std::filesystem::path name = std::filesystem::path(bag).filename();
  if (name.extension() == ".zst") name = name.stem();
  const std::string stem = name.stem().string();
  const std::size_t last = stem.find_last_not_of("0123456789");
  return last != std::string::npos && last + 1 < stem.size() && stem[last] == '_';
}

std::string packBagCheckpoint(BagCheckpoint checkpoint) {
  urban_nav_core::Archive archive;
  members(archive, checkpoint);
  return urban_nav_core::seal(kCheckpointName, kCheckpointVersion, archive.take());
}

BagCheckpoint unpackBagCheckpoint(std::string_view bytes) {
  try {
    return unpack(bytes, kCheckpointVersion, members);
  } catch (const urban_nav_core::DataError&) {
    return unpack(bytes, 1, membersOfVersion1);
  }
}

std::optional<std::size_t> coveredBags(const BagCheckpoint& checkpoint, const std::vector<std::string>& bags,
                                       urban_nav_core::StampNs begin) {
  for (std::size_t same = std::min(checkpoint.bags.size(), bags.size()); same > 0; --same)
    if (std::equal(bags.begin(), bags.begin() + static_cast<std::ptrdiff_t>(same),
                   checkpoint.bags.end() - static_cast<std::ptrdiff_t>(same)))
      return same;
  const double gap = urban_nav_core::secondsBetween(checkpoint.receipt, begin);
  if (bags.empty() || !(gap > 0.0) || gap >= urban_nav_input::kLongestSplit) return std::nullopt;
  return 0;
}

}  // namespace urban_nav
