// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/run_covariances.hpp"

#include <filesystem>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::Pose;
using urban_nav_input::TrajectoryFile;

namespace {

// Poses of both files are printed with full precision, so that they differ only by rounding (m, rad).
constexpr double kRounding = 1e-6;

bool haveSameMotion(const TrajectoryFile& camera, const TrajectoryFile& base) {
  if (camera.poses.size() != base.poses.size()) return false;
  const Pose T_camera_first = camera.poses.front().inverse(), T_base_first = base.poses.front().inverse();
  for (std::size_t i = 0; i < base.poses.size(); ++i)
    if (!isApprox(T_camera_first * camera.poses[i], T_base_first * base.poses[i], kRounding)) return false;
  return true;
}

}  // namespace

RunCovariances readRunCovariances(const TrajectoryFile& estimate) {
  const fs::path folder = fs::path(estimate.path).parent_path();
  const std::string covariance = (folder / "covariance.csv").string(), base = (folder / "trajectory.tum").string();
  if (!fs::exists(covariance)) return {};
  try {
    RunCovariances run{urban_nav_core::readCovariances(covariance), ""};
    if (estimate.stamped || run.rows.size() != estimate.poses.size()) return run;
    if (fs::exists(base) && haveSameMotion(estimate, urban_nav_input::readTrajectory(base))) return run;
    return {{},
            "no NEES: the covariances of " + covariance + " are of base_link, the poses of " + estimate.path +
                " of a camera" +
                (fs::exists(base) ? " whose motion differs, since it is mounted off base_link or tilted"
                                  : ", and there is no trajectory.tum to show that the motion is the same") +
                "; evaluate trajectory.tum with the truth of base_link, or give the camera's by --covariance"};
  } catch (const urban_nav_core::Error& error) {
    return {{}, std::string("no NEES: ") + error.what()};
  }
}

}  // namespace urban_nav
