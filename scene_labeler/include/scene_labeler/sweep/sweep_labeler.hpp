// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene_labeler/labelling/class_frequencies.hpp"
#include "scene_labeler/labelling/labeler.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"

namespace scene_labeler {

/// Labels of the returns of a sweep. Returns of one cube of 0.4 m have one answer.
struct SweepLabels {
  static constexpr std::uint32_t kNoAnswer = 0xffffffffU;

  std::vector<std::uint32_t> answer_of_return;  ///< row of `answers`; kNoAnswer beyond SweepLabeler::reach()
  SceneLabels answers;

  /// Returns the number of returns with an answer.
  std::size_t answered() const;
};

/// Labels the sweeps of a 3D LiDAR by shape, each in the cloud of the sweeps before and itself: a single sweep of few
/// rings has hardly any surface between its rings. The cost of a sweep depends on its number of occupied cubes, not on
/// the size of the cloud. The intensities of LiDARs are not used, since their units differ by make. Deterministic for
/// any number of threads. Not thread-safe.
class SweepLabeler {
 public:
  /// `superpixel`: parameter of the stage, which has no effect without images.
  SweepLabeler(std::shared_ptr<const LabelModel> model, int superpixel);
  ~SweepLabeler();
  SweepLabeler(SweepLabeler&&) noexcept;
  SweepLabeler& operator=(SweepLabeler&&) noexcept;

  /// Labels returns in a fixed frame, such as odom, in order of time. `place`: position of the sensor, in the same
  /// frame.
  SweepLabels label(const std::vector<urban_nav_core::LaserPoint>& returns, const Eigen::Vector3f& place);

  /// Returns the distance from the sensor, in plan view, up to which returns are labelled, m. Beyond it, the rings of
  /// sensors with 32 beams are further apart than the cubes that describe a surface.
  static double reach();
  /// Returns the number of cubes of 0.1 m in the cloud.
  std::size_t cloudSize() const;

 private:
  struct Cloud;
  void correctFrequencies(SceneLabels& answers);

  std::shared_ptr<const LabelModel> model_;
  int superpixel_;
  ClassFrequencies frequencies_;
  std::unique_ptr<Cloud> cloud_;
};

}  // namespace scene_labeler
