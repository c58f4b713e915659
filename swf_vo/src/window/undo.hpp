// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/filter.hpp"

namespace swf_vo {

/// Record of the steps whose poses are in the window: inputs, and the filter state before each step that marginalised.
/// With it a measurement can be inserted into or withdrawn from an earlier step exactly (reversible data association,
/// out-of-sequence measurements: Newman et al. 2009, section 2.2.1). Information marginalised since that step depends
/// on the measurement by its linearisation points and weights; so the filter returns to the step of the measurement and
/// repeats the later steps. The result is bit-identical to that of a filter that never had the measurement, or had it
/// in time. (In the first `size` frames, before any marginalisation, the measurement is inserted or withdrawn directly,
/// and the two agree up to the convergence of Gauss-Newton.) Cost: `size` copies of state and prior, and one update for
/// each repeated step.
class Undo {
 public:
  /// Call before addPose. `marginalises`: this step will marginalise.
  void beginStep(const Filter& filter, FrameId frame, const ProcessInput& u, bool marginalises, std::size_t size);
  /// Records an observation used by the filter; it may belong to an earlier step.
  void observed(const Observation& observation);
  void ended(LandmarkId landmark);

  /// Returns whether the measurement belongs to an earlier step than the last, and information was marginalised since.
  bool needsReplay(FrameId frame) const;
  /// Changes the record of an earlier step. Returns false if there is no such step or measurement, or if it exists
  /// already.
  bool insert(const Observation& observation);
  bool withdraw(LandmarkId landmark, FrameId frame);

  /// Removes a measurement that needs no replay from the record.
  void forget(LandmarkId landmark, FrameId frame);

  bool isPending() const { return pending_ >= 0; }
  /// Repeats the recorded steps from the earliest change. The last step is not updated.
  void replay(Filter& filter);

 private:
  struct Step {
    FrameId frame = 0;
    ProcessInput u;
    bool has_checkpoint = false;
    bool changed = false;
    Filter::Checkpoint before;
    std::vector<Observation> observations;
    std::vector<LandmarkId> ended;
  };

  Step* find(FrameId frame);
  const Step* find(FrameId frame) const;
  static bool erase(Step& step, LandmarkId landmark);
  void change(Step& step);

  std::vector<Step> steps_;  // oldest first
  int pending_ = -1;         // first changed step
  std::vector<SettledPose> unused_;
};

}  // namespace swf_vo
