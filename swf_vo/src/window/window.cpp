// SPDX-License-Identifier: BSD-3-Clause
#include "window/window.hpp"

#include <algorithm>

#include "window/filter.hpp"

namespace swf_vo {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::UncertainPose;

class Window::Implementation {
 public:
  Implementation(const WindowOptions& chosen, const StereoCamera& camera) : options(chosen), filter(chosen, camera) {}

  WindowOptions options;
  Filter filter;
  History history;
  std::vector<SettledPose> settled;
  mutable std::vector<MapPoint> map;
};

Window::Window(const WindowOptions& options, const StereoCamera& camera) : implementation_(std::make_unique<Implementation>(options, camera)) {}
Window::~Window() = default;
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;

void Window::start(FrameId frame, const Pose& T_odom_camera, const Matrix6d& information) {
  implementation_->filter.start(frame, T_odom_camera, information);
}

void Window::addPose(FrameId frame, const ProcessInput& u) { implementation_->filter.addPose(frame, u); }

void Window::removePoses() {
  implementation_->settled.clear();
  implementation_->filter.removePoses(implementation_->settled, implementation_->options.keep_history ? &implementation_->history : nullptr);
}

const std::vector<SettledPose>& Window::settled() const { return implementation_->settled; }

bool Window::fixLandmark(const MapPoint& point) { return implementation_->filter.fixLandmark(point); }
bool Window::observe(const Observation& observation) { return implementation_->filter.observe(observation); }
bool Window::withdraw(LandmarkId landmark, FrameId frame) { return implementation_->filter.withdraw(landmark, frame); }

void Window::withdrawAll(LandmarkId landmark) {
  const State& state = implementation_->filter.state();
  for (int slot = state.slotOf(landmark); slot >= 0 && !state.landmarks[static_cast<std::size_t>(slot)].seen.empty(); slot = state.slotOf(landmark)) {
    const std::int64_t step = state.landmarks[static_cast<std::size_t>(slot)].seen.back().step;
    withdraw(landmark, state.poses[static_cast<std::size_t>(step - state.first_step)].frame);
  }
}

void Window::endLandmark(LandmarkId landmark) { implementation_->filter.endLandmark(landmark); }
UpdateReport Window::update() { return implementation_->filter.update(); }
UncertainPose Window::newest() const { return implementation_->filter.newest(); }
bool Window::hasPose(FrameId frame) const { return implementation_->filter.state().poseOf(frame) >= 0; }

Pose Window::pose(FrameId frame) const {
  const State& state = implementation_->filter.state();
  return state.poses[static_cast<std::size_t>(std::max(0, state.poseOf(frame)))].estimate;
}

const std::vector<MapPoint>& Window::map() const {
  std::vector<MapPoint>& map = implementation_->map;
  map.clear();
  for (const LandmarkBlock& landmark : implementation_->filter.state().landmarks)
    if (landmark.used && landmark.followed) map.push_back({landmark.id, landmark.anchor.homogeneous(landmark.estimate)});
  std::sort(map.begin(), map.end(), [](const MapPoint& a, const MapPoint& b) { return a.landmark < b.landmark; });
  return map;
}

double Window::weight(LandmarkId landmark) const {
  const State& state = implementation_->filter.state();
  const int slot = state.slotOf(landmark);
  if (slot < 0 || state.landmarks[static_cast<std::size_t>(slot)].seen.empty()) return 1.0;
  return state.landmarks[static_cast<std::size_t>(slot)].seen.back().weight;
}

std::vector<SettledPose> Window::flush() {
  std::vector<SettledPose> left;
  implementation_->filter.flush(left);
  return left;
}

std::map<FrameId, Pose> Window::trajectory() const { return implementation_->history.solve(implementation_->filter.state()); }

const Filter& Window::filter() const { return implementation_->filter; }

}  // namespace swf_vo
