// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"

namespace loop_metric {

/// Which kept views may show the same as a new one, by how well their descriptors answer each other: candidates to be registered, nothing more. Every view is
/// looked at, so it serves a map of some kilometres (60 kB and 0.3 ms a view): a stand-in where no place recognition is. Adding is not thread-safe, finding is.
class ViewFinder {
 public:
  explicit ViewFinder(const urban_nav_core::StereoCamera& camera);
  ~ViewFinder();
  ViewFinder(ViewFinder&&) noexcept;
  ViewFinder& operator=(ViewFinder&&) noexcept;

  /// One without readable image or points is left out: false.
  bool add(const Keyframe& keyframe);
  std::size_t size() const;

  struct Found {
    std::size_t view = 0;  ///< counted as they were added
    double score = 0.0;    ///< of no meaning but to compare with others of this call
  };
  /// The best first, at most so many; of equal ones the one that was added first.
  std::vector<Found> find(const Keyframe& keyframe, std::size_t most) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace loop_metric
