// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "base/scratch_folder.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// A store whose chunks agree with its poses: the store itself, or, if edits have moved poses since rendering, a
/// temporary copy with the map rendered again, which is removed with this object. The store is only read, and must
/// outlive this object.
class CurrentRendering {
 public:
  CurrentRendering(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);
  ~CurrentRendering();
  CurrentRendering(const CurrentRendering&) = delete;
  CurrentRendering& operator=(const CurrentRendering&) = delete;

  urban_nav_store::Store& store() { return copy_ ? *copy_ : store_; }

 private:
  void render(const std::vector<urban_nav_store::StoredTrajectory>& map);

  urban_nav_store::Store& store_;
  std::unique_ptr<ScratchFolder> folder_;  // for the copy
  std::unique_ptr<urban_nav_store::Store> copy_;
};

}  // namespace urban_nav
