// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo_run_state.hpp"

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::Archive;

namespace {

constexpr const char* kLoRunName = "laser odometry of a session";
constexpr std::uint32_t kLoRunVersion = 4;

/// A sweep in a stored state.
struct StoredSweep {
  OdometryFrame frame;
  LoFigures figures;
};

void archive(Archive& archive, StoredSweep& row) {
  laser_odometry::Statistics& figures = row.figures.statistics;
  archive(row.frame.frame, row.frame.stamp, row.frame.accepted, row.frame.status, row.frame.T_odom_base);
  archive(figures.points, figures.near, figures.used, figures.moving, figures.patches, figures.iterations,
          figures.map_cells, figures.residual_m, figures.deskewed);
  archive(row.figures.free_directions, row.figures.process_ms);
}

/// A pose in a stored state.
struct StoredPose {
  SmoothedFrame frame;
};

void archive(Archive& archive, StoredPose& row) {
  archive(row.frame.frame, row.frame.stamp, row.frame.T_odom_base, row.frame.from_previous, row.frame.status);
}

struct StoredLoRun {
  std::vector<StoredSweep> sweeps;
  std::vector<StoredPose> poses;
};

void archiveMembers(Archive& archive, LoRun& run, StoredLoRun& stored) {
  archive(run.role, run.is_planar, run.T_base_lidar, stored.sweeps, stored.poses, run.surface, run.faults,
          run.faults_total, run.forces, run.motion);
  archive.require(stored.poses.size() <= stored.sweeps.size(), "more poses than sweeps");
}

}  // namespace

std::string packLoRun(LoRun run) {
  StoredLoRun stored;
  for (std::size_t i = 0; i < run.frames.size(); ++i) stored.sweeps.push_back({run.frames[i], run.figures[i]});
  for (const SmoothedFrame& frame : run.settled) stored.poses.push_back({frame});
  Archive writer;
  archiveMembers(writer, run, stored);
  return urban_nav_core::seal(kLoRunName, kLoRunVersion, writer.take());
}

std::optional<LoRun> unpackLoRun(std::string_view bytes) {
  try {
    Archive reader(urban_nav_core::unseal(kLoRunName, kLoRunVersion, bytes), kLoRunName);
    LoRun run;
    StoredLoRun stored;
    archiveMembers(reader, run, stored);
    reader.finish();
    for (const StoredSweep& row : stored.sweeps) {
      run.frames.push_back(row.frame);
      run.figures.push_back(row.figures);
    }
    for (const StoredPose& row : stored.poses) run.settled.push_back(row.frame);
    run.source = OdometrySource::Laser;
    return run;
  } catch (const urban_nav_core::DataError&) {
    return std::nullopt;
  }
}

}  // namespace urban_nav
