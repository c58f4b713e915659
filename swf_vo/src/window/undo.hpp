// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/filter.hpp"

namespace swf_vo {

/// The inputs of the steps whose poses are in the window, and where the filter stood before each that marginalised
/// something: so that a measurement can go in or out of the past exactly (reversible data association, out-of-sequence
/// measurements: Newman et al. 2009, section 2.2.1). What went into the prior since was linearised and weighted with it
/// or without it; so the filter goes back to the step of the measurement and takes the later steps again: what results
/// is, to the last bit, the filter that never had it, or had it in time. (Of the first `size` frames, before which
/// nothing was marginalised, it goes in or out by itself, and the two agree as far as Gauss-Newton converges.) Costs
/// `size` copies of state and prior, and as many updates as steps are taken again.
class Undo {
 public:
  /// Before addPose: `marginalises` says whether this step will take information out of the window.
  void beginStep(const Filter& filter, FrameId frame, const ProcessInput& u, bool marginalises, std::size_t size);
  /// Notes what the filter took; it may be of an earlier step.
  void observed(const Observation& observation);
  void ended(LandmarkId landmark);

  /// The measurement belongs to an earlier step than the last, and something was marginalised since.
  bool needsReplay(FrameId frame) const;
  /// Changes the record of an earlier step; false if there is no such step or measurement, or it is there already.
  bool insert(const Observation& observation);
  bool withdraw(LandmarkId landmark, FrameId frame);

  /// Takes a measurement out of the record that needs no replay.
  void forget(LandmarkId landmark, FrameId frame);

  bool isPending() const { return pending_ >= 0; }
  /// Takes the recorded steps again from the earliest change. The last step is left before its update.
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
