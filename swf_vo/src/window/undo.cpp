// SPDX-License-Identifier: BSD-3-Clause
#include "window/undo.hpp"

#include <algorithm>

namespace swf_vo {

void Undo::beginStep(const Filter& filter, FrameId frame, const ProcessInput& u, bool marginalises, std::size_t size) {
  // The oldest record is moved to the end and overwritten, to reuse its memory.
  if (steps_.size() > size) std::rotate(steps_.begin(), steps_.begin() + 1, steps_.end());
  else steps_.emplace_back();
  Step& step = steps_.back();
  step.frame = frame;
  step.u = u;
  step.observations.clear();
  step.ended.clear();
  for (const Step& other : steps_) {
    step.observations.reserve(other.observations.capacity());
    step.ended.reserve(other.ended.capacity());
  }
  step.changed = false;
  step.has_checkpoint = marginalises;
  if (!marginalises) return;
  step.before.state.reserveLike(filter.state());
  step.before.prior.reserveLike(filter.prior());
  filter.save(step.before);
}

void Undo::observed(const Observation& observation) {
  if (Step* step = find(observation.frame)) step->observations.push_back(observation);
}

void Undo::ended(LandmarkId landmark) {
  if (!steps_.empty()) steps_.back().ended.push_back(landmark);
}

const Undo::Step* Undo::find(FrameId frame) const {
  const auto at = std::find_if(steps_.begin(), steps_.end(), [&](const Step& step) { return step.frame == frame; });
  return at == steps_.end() ? nullptr : &*at;
}

Undo::Step* Undo::find(FrameId frame) { return const_cast<Step*>(static_cast<const Undo*>(this)->find(frame)); }

bool Undo::needsReplay(FrameId frame) const {
  if (isPending()) return true;
  return std::any_of(steps_.begin(), steps_.end(),
                     [&](const Step& step) { return step.has_checkpoint && step.frame > frame; });
}

void Undo::change(Step& step) {
  step.changed = true;
  const int at = static_cast<int>(&step - steps_.data());
  pending_ = isPending() ? std::min(pending_, at) : at;
}

bool Undo::insert(const Observation& observation) {
  Step* step = find(observation.frame);
  if (step == nullptr || !observation.z.allFinite() || !observation.information.allFinite()) return false;
  for (const Observation& known : step->observations)
    if (known.landmark == observation.landmark) return false;
  step->observations.push_back(observation);
  change(*step);
  return true;
}

bool Undo::erase(Step& step, LandmarkId landmark) {
  const auto same = [&](const Observation& observation) { return observation.landmark == landmark; };
  const auto at = std::find_if(step.observations.begin(), step.observations.end(), same);
  if (at == step.observations.end()) return false;
  step.observations.erase(at);
  return true;
}

void Undo::forget(LandmarkId landmark, FrameId frame) {
  if (Step* step = find(frame)) erase(*step, landmark);
}

bool Undo::withdraw(LandmarkId landmark, FrameId frame) {
  Step* step = find(frame);
  if (step == nullptr || !erase(*step, landmark)) return false;
  change(*step);
  return true;
}

void Undo::replay(Filter& filter) {
  if (!isPending()) return;
  // Before the first checkpoint nothing was marginalised: measurements are withdrawn individually.
  std::size_t from = static_cast<std::size_t>(pending_);
  while (from < steps_.size() && !steps_[from].has_checkpoint) ++from;
  pending_ = -1;
  if (from == steps_.size()) return;
  const Filter::Published published = filter.published();
  filter.restore(steps_[from].before);
  bool changed = false;
  for (std::size_t i = 0; i < from; ++i) {
    if (!steps_[i].changed) continue;
    filter.setMeasurements(steps_[i].frame, steps_[i].observations);
    changed = true;
  }
  if (changed) filter.update();
  for (Step& step : steps_) step.changed = false;
  for (std::size_t i = from; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    if (i > from && step.has_checkpoint) filter.save(step.before);
    filter.addPose(step.frame, step.u);
    unused_.clear();
    filter.removePoses(unused_, nullptr);
    for (const Observation& observation : step.observations) filter.observe(observation);
    for (const LandmarkId landmark : step.ended) filter.endLandmark(landmark);
    if (i + 1 < steps_.size()) filter.update();
  }
  filter.publish(published);
}

}  // namespace swf_vo
