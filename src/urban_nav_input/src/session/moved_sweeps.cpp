// SPDX-License-Identifier: BSD-3-Clause
#include "session/moved_sweeps.hpp"

#include <iterator>
#include <utility>

namespace urban_nav_input {

namespace {

void archiveSweep(urban_nav_core::Archive& archive, SweepInput& input) {
  urban_nav_core::Sweep& sweep = input.sweep;
  archive(input.role, input.T_base_lidar, input.is_planar, sweep.reference, sweep.duration, sweep.times);
  std::size_t size = sweep.beams.size();
  archive.count(size);
  sweep.beams.resize(size);
  for (urban_nav_core::Beam& beam : sweep.beams) {
    int ring = beam.ring, column = beam.column;
    archive(beam.stamp, beam.direction, beam.range, beam.intensity, ring, column);
    beam.ring = static_cast<std::uint16_t>(ring);
    beam.column = static_cast<std::uint16_t>(column);
  }
}

}  // namespace

void MovedSweeps::add(std::vector<SweepInput> sweeps) {
  if (!queue_) {
    std::move(sweeps.begin(), sweeps.end(), std::back_inserter(ready_));
    return;
  }
  for (SweepInput& input : sweeps) {
    const urban_nav_core::Sweep& sweep = input.sweep;
    const urban_nav_core::StampNs end = sweep.beams.empty() ? sweep.reference : sweep.beams.back().stamp;
    queue_->add(end, std::move(input));
  }
}

std::vector<SweepInput> MovedSweeps::take() {
  while (queue_) {
    auto ready = queue_->take();
    if (!ready) break;
    ready->sweep.inputs = std::move(ready->inputs);
    ready_.push_back(std::move(ready->sweep));
  }
  return std::exchange(ready_, {});
}

void MovedSweeps::archive(urban_nav_core::Archive& archive) {
  bool is_expecting = queue_.has_value();
  archive(is_expecting);
  archive.require(is_expecting == queue_.has_value(), "motion sensors in all bags, or in none");
  if (queue_) queue_->archive(archive, archiveSweep);
}

}  // namespace urban_nav_input
