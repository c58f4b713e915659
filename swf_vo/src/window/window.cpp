// SPDX-License-Identifier: BSD-3-Clause
#include "window/window.hpp"

#include <algorithm>
#include <cassert>

#include "window/drifting_landmarks.hpp"
#include "window/filter.hpp"
#include "window/undo.hpp"

namespace swf_vo {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StereoCamera;

class Window::Implementation {
 public:
  Implementation(const WindowOptions& chosen, const StereoCamera& camera) : options(chosen), filter(chosen, camera) {
    frames.reserve(static_cast<std::size_t>(std::clamp(chosen.size, 1, 256)) + 2);  // frames with measurements of one
                                                                                    // landmark
  }

  // Returns whether a measurement belongs to an earlier frame and information was marginalised since.
  bool isLate(FrameId frame) const {
    return options.exact_undo && filter.state().toPose(frame) >= 0 && undo.needsReplay(frame);
  }

  WindowOptions options;
  Filter filter;
  Undo undo;
  History history;
  DriftingLandmarks driftingLandmarks;
  std::vector<SettledPose> settled;
  std::vector<FrameId> frames;
  mutable std::vector<MapPoint> map;
};

Window::Window(const WindowOptions& options, const StereoCamera& camera)
    : implementation_(std::make_unique<Implementation>(options, camera)) {}
Window::~Window() = default;
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;

void Window::start(FrameId frame, const Pose& T_odom_camera, const Matrix6d& information) {
  implementation_->filter.start(frame, T_odom_camera, information);
  if (implementation_->options.exact_undo)
    implementation_->undo.beginStep(implementation_->filter, frame, ProcessInput(), false, 1);
}

void Window::addPose(FrameId frame, const ProcessInput& u) {
  Implementation& all = *implementation_;
  if (all.options.exact_undo) {
    if (all.undo.isPending()) update();
    all.undo.beginStep(all.filter, frame, u, all.filter.isFull(),
                       static_cast<std::size_t>(std::max(1, all.options.size)));
  }
  all.filter.addPose(frame, u);
}

void Window::restart(FrameId frame, const ProcessInput& u) {
  Implementation& all = *implementation_;
  all.settled.clear();
  all.filter.restart(frame, u, all.settled);
  if (!all.options.exact_undo) return;
  all.undo = Undo();
  all.undo.beginStep(all.filter, frame, u, false, 1);
}

void Window::removePoses() {
  implementation_->settled.clear();
  implementation_->filter.removePoses(implementation_->settled,
                                      implementation_->options.keep_history ? &implementation_->history : nullptr);
}

const std::vector<SettledPose>& Window::settled() const { return implementation_->settled; }

bool Window::fixLandmark(const MapPoint& point) { return implementation_->filter.fixLandmark(point); }

bool Window::observe(const Observation& observation) {
  Implementation& all = *implementation_;
  if (all.isLate(observation.frame)) return all.undo.insert(observation);
  if (!all.filter.observe(observation)) return false;
  if (all.options.exact_undo) all.undo.observed(observation);
  return true;
}

bool Window::withdraw(LandmarkId landmark, FrameId frame) {
  Implementation& all = *implementation_;
  if (all.isLate(frame)) return all.undo.withdraw(landmark, frame);
  if (!all.filter.withdraw(landmark, frame)) return false;
  if (all.options.exact_undo) all.undo.forget(landmark, frame);
  return true;
}

void Window::withdrawAll(LandmarkId landmark) {
  Implementation& all = *implementation_;
  const int slot = all.filter.state().findSlot(landmark);
  if (slot < 0) return;
  const State& state = all.filter.state();
  all.frames.clear();
  for (const Measurement& measurement : state.landmarks[static_cast<std::size_t>(slot)].seen)
    all.frames.push_back(state.poses[static_cast<std::size_t>(measurement.step - state.first_step)].frame);
  for (const FrameId frame : all.frames) withdraw(landmark, frame);
}

void Window::endLandmark(LandmarkId landmark) {
  implementation_->filter.endLandmark(landmark);
  if (implementation_->options.exact_undo) implementation_->undo.ended(landmark);
}

UpdateReport Window::update() {
  implementation_->undo.replay(implementation_->filter);
  return implementation_->filter.update();
}

const std::vector<LandmarkId>& Window::driftingLandmarks() {
  return implementation_->driftingLandmarks.find(implementation_->filter.state(),
                                                 implementation_->filter.cost().sensor());
}

PoseWithCovariance Window::newest() const { return implementation_->filter.newest(); }
std::size_t Window::poses() const { return implementation_->filter.state().poses.size(); }
bool Window::hasPose(FrameId frame) const { return implementation_->filter.state().toPose(frame) >= 0; }

Pose Window::pose(FrameId frame) const {
  const State& state = implementation_->filter.state();
  return state.poses[static_cast<std::size_t>(std::max(0, state.toPose(frame)))].estimate;
}

double Window::disparityOffset() const { return implementation_->filter.state().disparity_offset; }
double Window::disparityOffsetSigma() const { return implementation_->filter.disparityOffsetSigma(); }

double Window::scaleSigma() const { return implementation_->filter.scaleSigma(); }

const std::vector<MapPoint>& Window::map() const {
  std::vector<MapPoint>& map = implementation_->map;
  map.clear();
  for (const LandmarkBlock& landmark : implementation_->filter.state().landmarks)
    if (landmark.used && landmark.followed)
      map.push_back({landmark.id, landmark.anchor.homogeneous(landmark.estimate)});
  std::sort(map.begin(), map.end(), [](const MapPoint& a, const MapPoint& b) { return a.landmark < b.landmark; });
  return map;
}

double Window::weight(LandmarkId landmark) const {
  const State& state = implementation_->filter.state();
  const int slot = state.findSlot(landmark);
  if (slot < 0 || state.landmarks[static_cast<std::size_t>(slot)].seen.empty()) return 1.0;
  return state.landmarks[static_cast<std::size_t>(slot)].seen.back().weight;
}

std::vector<SettledPose> Window::flush() {
  std::vector<SettledPose> left;
  implementation_->filter.flush(left);
  return left;
}

std::map<FrameId, Pose> Window::trajectory() const {
  return implementation_->history.solve(implementation_->filter.state());
}

const Filter& Window::filter() const { return implementation_->filter; }

void Window::archive(urban_nav_core::Archive& archive) {
  assert(!implementation_->options.exact_undo && !implementation_->options.keep_history);
  archive(implementation_->filter);
}

}  // namespace swf_vo
