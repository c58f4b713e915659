// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav {

/// Writes the true depth and class of pixels and beams to the truth folder, by the stamps of the measurements: for a
/// camera FRAME/STAMP_NS.pfm (depth, m) and .png (class), for a 3D LiDAR both with a row per ring, for a laser
/// FRAME.csv (`stamp_ns,beam,range_m,class`; ranges without a surface are empty). Removes those of an earlier run.
/// Throws UserError if a file cannot be written.
class ViewWriter {
 public:
  explicit ViewWriter(std::string folder);

  void add(const urban_nav_sim::ViewTruth& view);
  /// Writes the files of the lasers.
  void finish();

 private:
  void addPicture(const urban_nav_sim::ViewTruth& view);
  void addBeams(const urban_nav_sim::ViewTruth& view);

  std::string folder_;
  std::map<std::string, std::unique_ptr<urban_nav_core::AtomicFile>> beams_;
};

}  // namespace urban_nav
