// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav {

/// What pixels and beams truly met, into the truth folder, under the stamps of the measurements: of a camera
/// FRAME/STAMP_NS.pfm (depth, m) and .png (class), of a 3D LiDAR the same with a row for each ring, of a laser
/// FRAME.csv (`stamp_ns,beam,range_m,class`; ranges without a surface are empty). Those of an earlier run are removed.
/// Throws UserError where they cannot be written.
class ViewWriter {
 public:
  explicit ViewWriter(std::string folder);

  void add(const urban_nav_sim::ViewTruth& view);
  /// Files of lasers appear with it.
  void finish();

 private:
  void addPicture(const urban_nav_sim::ViewTruth& view);
  void addBeams(const urban_nav_sim::ViewTruth& view);

  std::string folder_;
  std::map<std::string, std::unique_ptr<urban_nav_core::AtomicFile>> beams_;
};

}  // namespace urban_nav
