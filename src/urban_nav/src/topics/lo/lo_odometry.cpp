// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/parameters.hpp"
#include "topics/lo/lo.hpp"
#include "topics/lo/lo_recorder.hpp"

namespace urban_nav {

urban_nav_core::Trajectory runLaserOdometry(urban_nav_input::Source& source, const ParameterSet& parameters,
                                            Console& console) {
  LoRun run;
  LoRecorder recorder(parameters.get(laser_odometry::table()), source.info(), run);
  Progress progress(console, "lo", "sweeps", source.info().frames);
  const auto add = [&](const std::vector<urban_nav_input::SweepInput>& sweeps) {
    for (const urban_nav_input::SweepInput& sweep : sweeps) recorder.process(sweep);
    progress.update(static_cast<std::int64_t>(run.frames.size()));
  };
  while (const auto item = source.next()) {
    if (item->bag_end) add(item->bag_end->sweeps);
    add(item->sweeps);
  }
  if (source.bagEnd()) add(source.bagEnd()->sweeps);
  add(source.sweeps());
  progress.finish(static_cast<std::int64_t>(run.frames.size()));
  recorder.finish({source.closingFaults(), {}});
  for (const std::string& fault : run.faults) console.warn(fault);
  return smoothedTrajectory(run);
}

}  // namespace urban_nav
