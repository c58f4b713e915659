// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"

namespace urban_nav_registration {

/// Finds stored keyframes that may show the same place as a new one by the similarity of their descriptors. The results
/// are candidates for registration. All keyframes are compared, so that it suits maps of some kilometres (60 kB and 0.3
/// ms a keyframe), until place recognition replaces it. find() is thread-safe, add() is not.
class DescriptorVoting {
 public:
  explicit DescriptorVoting(const urban_nav_core::StereoCamera& camera);
  ~DescriptorVoting();
  DescriptorVoting(DescriptorVoting&&) noexcept;
  DescriptorVoting& operator=(DescriptorVoting&&) noexcept;

  /// Appends a keyframe. Returns false, and the keyframe is never found, if it has no readable image or no points.
  bool add(const Keyframe& keyframe);
  std::size_t size() const;

  struct Found {
    std::size_t view = 0;  ///< index in the order of add()
    double score = 0.0;    ///< comparable within one call only
  };
  /// Returns the best keyframes, best first, at most `most`. Of equal ones the first added comes first.
  std::vector<Found> find(const Keyframe& keyframe, std::size_t most) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_registration
