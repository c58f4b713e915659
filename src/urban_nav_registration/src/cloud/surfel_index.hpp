// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "urban_nav_registration/cloud/cell_table.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// Finds the piece of surface next to a point, out to a fixed distance. Made from the surfels of planarity above 0
/// alone; the surfels are copied, so that a look-up reads neighbours in one go. Immutable, so thread-safe.
class SurfelIndex {
 public:
  /// `reach`: how far a surfel may be away, m. `finer`: an index of the same surfels with a smaller reach, which is
  /// asked first: most have something near.
  SurfelIndex(const std::vector<Surfel>& surfels, float reach, std::shared_ptr<const SurfelIndex> finer = nullptr);

  float reach() const { return reach_; }
  struct Nearest {
    const Surfel* surfel = nullptr;
    float margin = 0.0F;  ///< m that the point may move, the normal kept, and this one stays the nearest within reach
  };
  /// The nearest surfel within reach whose normal is within 45 deg of `normal`, either way round; null where there is
  /// none. Of equally near ones the first.
  Nearest nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

 private:
  std::shared_ptr<const SurfelIndex> finer_;
  float reach_, per_m_;
  CellTable table_;
  std::vector<std::uint32_t> begins_;  // of each cell in sorted_; one more at the end
  std::vector<Surfel> sorted_;
  std::array<std::vector<float>, 6>
      lanes_;  // x, y, z of the means and of the normals in that order, and a few more at the end
};

}  // namespace urban_nav_registration
