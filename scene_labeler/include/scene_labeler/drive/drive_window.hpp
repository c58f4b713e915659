// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "scene_labeler/drive/drive_scene.hpp"

namespace scene_labeler {

/// Image of a side camera along the path; without an image, returns near it are described by shape only.
struct DriveFrame {
  urban_nav_core::StampNs stamp = 0;
  double travelled = 0.0;  ///< m along the path
  SideView view;
};

/// Receives the frames of DriveWindow. Indices of returns count from the first return of the drive.
class DriveObserver {
 public:
  /// Interval of the path, m, in which no other frame is nearer.
  struct Stretch {
    double begin = 0.0, end = 0.0;
    bool holds(double travelled) const { return travelled >= begin && travelled < end; }
  };
  virtual ~DriveObserver() = default;
  /// `returns`: within reach of the frame along the path; `first`: index of the first of them.
  virtual void observe(const DriveFrame& frame, const Stretch& nearest, std::size_t first,
                       const std::vector<DriveReturn>& returns) = 0;
  /// Returns before this index are not visible in any later frame.
  virtual void settle(std::size_t end) = 0;
};

/// Collects the returns of one laser around each frame of the camera on its side. Returns must be in order of time; for
/// a standing robot, at most about four million are kept. Not thread-safe.
class DriveWindow {
 public:
  /// The observer must outlive the window. `reach`: m along the path, before and after a frame.
  DriveWindow(double reach, DriveObserver& observer) : reach_(reach), observer_(observer) {}

  void add(const DriveReturn& one);
  /// Frames must be in order along the path.
  void add(DriveFrame frame);
  void finish();

 private:
  void work(bool is_end);
  void drop(double before);

  const double reach_;
  DriveObserver& observer_;
  std::vector<DriveReturn> returns_;
  std::size_t first_ = 0;  // index of returns_[0]
  std::deque<DriveFrame> frames_;
  bool has_previous_ = false;
  double previous_ = 0.0;  // distance of the frame before frames_.front()
};

}  // namespace scene_labeler
