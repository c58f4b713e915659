// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/teach/teach_units.hpp"

#include <limits>
#include <unordered_map>

#include "scene_labeler/labelling/superpixels.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace urban_nav {

using scene_labeler::kNoPatch;

namespace {

constexpr float kAreaCube = 0.2F;  // m, as the areas of labels.csv

}  // namespace

TeachUnits::TeachUnits(const scene_labeler::Scene& scene, int superpixel) : places_(scene.points) {
  const std::vector<std::uint32_t> cubes = scene_labeler::makePatches(scene, {});
  std::vector<std::uint32_t> patches(places_.size(), kNoPatch);
  if (!scene.view.image.empty())
    patches = scene_labeler::makePatches(scene, scene_labeler::makeSuperpixels(scene.view.image, superpixel));
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  unit_of_.assign(places_.size(), kNone);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const bool is_shown = patches[i] != kNoPatch;
    if (!is_shown && cubes[i] == kNoPatch) continue;
    const std::uint64_t key = is_shown ? patches[i] : std::uint64_t{1} << 32U | cubes[i];
    unit_of_[i] = numbers.emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
  }
  centres_.assign(numbers.size(), Eigen::Vector3f::Zero());
  group();
  measure();
}

void TeachUnits::group() {
  first_.assign(centres_.size() + 1, 0);
  for (const std::uint32_t unit : unit_of_)
    if (unit != kNone) ++first_[unit + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  members_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < unit_of_.size(); ++i)
    if (unit_of_[i] != kNone) members_[next[unit_of_[i]]++] = i;
}

void TeachUnits::measure() {
  areas_.assign(centres_.size(), 0.0F);
  middles_.assign(centres_.size(), 0);
  for (std::uint32_t unit = 0; unit < centres_.size(); ++unit) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    urban_nav_registration::CellTable cells(count(unit));
    for (std::size_t m = first_[unit]; m < first_[unit + 1]; ++m) {
      const Eigen::Vector3f& p = places_[members_[m]];
      sum += p.cast<double>();
      cells.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(p, 1.0F / kAreaCube)));
    }
    centres_[unit] = (sum / static_cast<double>(count(unit))).cast<float>();
    areas_[unit] = kAreaCube * kAreaCube * static_cast<float>(cells.size());
    float nearest = std::numeric_limits<float>::max();
    for (std::size_t m = first_[unit]; m < first_[unit + 1]; ++m) {
      const float square = (places_[members_[m]] - centres_[unit]).squaredNorm();
      if (square >= nearest) continue;
      nearest = square;
      middles_[unit] = members_[m];
    }
  }
}

std::vector<std::uint32_t> TeachUnits::members(std::uint32_t unit) const {
  return {members_.begin() + first_[unit], members_.begin() + first_[unit + 1]};
}

std::vector<std::uint32_t> TeachUnits::near(std::uint32_t point, float radius) const {
  std::vector<std::uint32_t> found;
  if (point >= unit_of_.size() || unit_of_[point] == kNone) return found;
  for (std::uint32_t unit = 0; unit < centres_.size(); ++unit)
    if (unit == unit_of_[point] || (centres_[unit] - places_[point]).squaredNorm() < radius * radius)
      found.push_back(unit);
  return found;
}

}  // namespace urban_nav
