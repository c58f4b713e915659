// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "topics/labels/scene_files.hpp"
#include "topics/labels/teach/correction_list.hpp"

namespace urban_nav {

/// File of the corrections of a scene: binary PLY `x y z [reflectance] label`, with the points of the scene in their
/// order, label 255 without a correction; the input of `labels train --corrections`. Comments in its header hold each
/// correction, so that they can be undone after a restart, and the file of a scene with an image, which is then used
/// for training. Not thread-safe.
class CorrectionFile {
 public:
  /// `files` and `input`: the scene; both are copied as far as needed. `superpixel`: edge of a superpixel, px.
  CorrectionFile(std::string path, const SceneFiles& files, const SceneInput& input, int superpixel);

  const std::string& path() const { return path_; }
  bool exists() const;
  /// Returns the corrections in the file; classes that another program wrote are the base of the list. Throws UserError
  /// for a file without labels or of another cloud.
  CorrectionList read(const TeachUnits& units) const;
  /// Writes the corrections that are not undone, completely or not at all. Throws UserError naming the path.
  void write(const CorrectionList& corrections, const TeachUnits& units) const;

 private:
  void requireSameCloud() const;

  std::string path_, scene_path_;
  int superpixel_;
  Eigen::Vector3d offset_;
  std::vector<Eigen::Vector3f> points_;
  std::string vertices_;      // without labels
  std::size_t vertex_bytes_;  // of these
  bool has_image_, is_far_, has_reflectance_;
};

/// Returns the file of the scene with an image that the header of a file of corrections names; empty without one.
std::string picturedScene(const std::string& path);

}  // namespace urban_nav
