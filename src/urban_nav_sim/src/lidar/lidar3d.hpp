// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "laser/beam_echoes.hpp"
#include "lidar/lidar_pattern.hpp"
#include "motion/motion.hpp"
#include "noise/noise.hpp"
#include "ray_tracing/tracer.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace urban_nav_sim {

/// Surfaces hit by the beams of a sweep, without noise: one value per ring and column, at `ring * columns + column`.
struct SweepTruth {
  int rings = 0, columns = 0;
  std::vector<float> range;  ///< m along the beam; infinite for the sky
  std::vector<SurfaceClass> surface_class;
};

/// A 3D LiDAR with 16 to 128 rings or a rosette pattern. Each beam is cast from the pose of its time among moving
/// objects of that time. Errors: Velodyne's data sheets (HDL-64E, VLP-16), Glennie and Lichti 2010 for the rings.
/// Immutable, hence thread-safe; uses several threads, without effect on the result. The tracer must outlive it.
class Lidar3d {
 public:
  struct Settings {
    double sigma = 0.02;                            ///< m, range noise of each beam; 0: also no noise of intensities
    double ring_range_sigma = 0.01;                 ///< m, standard deviation of the constant range bias of a ring
    double ring_angle_sigma = 0.02 * M_PI / 180.0;  ///< rad, standard deviation of its constant elevation error
    double step = 2e-3;                             ///< m, resolution of ranges; 0: none, also of intensities
    double range_min = 0.5, range_max = 120.0;      ///< m
    bool mixes = true;                              ///< echoes of two surfaces at an edge give a range between them
    bool loses = true;                              ///< weak echoes and 0.3 % of the beams are lost
    bool has_times = true;                          ///< false: all beams have the stamp of the end of the sweep

    /// Without noise, biases, steps, mixed pixels and losses.
    static Settings exact();
  };

  /// Constant errors of a ring.
  struct RingError {
    double range = 0.0;      ///< m, measured minus true
    double elevation = 0.0;  ///< rad, true minus nominal
  };

  /// `seed`: of ring errors and noise.
  Lidar3d(const Tracer& tracer, const urban_nav_core::Pose& T_base_lidar, std::uint64_t seed, const LidarModel& model,
          const Settings& settings);

  /// Returns the `number`-th sweep, which ends at `t_end` (s of the session) and begins one period earlier. `stamp`: of
  /// its end. Directions are those stated by the device, with nominal elevations. `truth`, if not null, is overwritten.
  urban_nav_core::Sweep sweep(const Motion& motion, double t_end, urban_nav_core::StampNs stamp, std::uint64_t number,
                              SweepTruth* truth = nullptr) const;

  const LidarPattern& pattern() const { return pattern_; }
  const std::vector<RingError>& ringErrors() const { return ring_errors_; }

 private:
  struct Return;
  struct Column;
  void castColumn(const Snapshot& snapshot, const Column& column, Return* returns) const;
  std::vector<Return> castSweep(const Motion& motion, double t_sweep, std::uint64_t number) const;
  Return measured(const Echo& echo, const Echo& truth, int ring, const Noise& noise) const;

  const Tracer& tracer_;
  urban_nav_core::Pose T_base_lidar_;
  LidarPattern pattern_;
  Settings settings_;
  Noise noise_;
  std::vector<RingError> ring_errors_;
};

}  // namespace urban_nav_sim
