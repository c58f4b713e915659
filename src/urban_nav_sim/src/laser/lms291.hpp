// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "laser/beam_echoes.hpp"
#include "motion/motion.hpp"
#include "noise/noise.hpp"
#include "ray_tracing/tracer.hpp"
#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_sim {

/// Surface hit by a beam, without noise.
struct BeamTruth {
  double range = 0.0;  ///< m along the centre of the beam; infinite for the sky
  SurfaceClass surface_class = SurfaceClass::Other;
};

/// A SICK LMS291-S14 (Telegram listing and data sheet of SICK): 181 beams of 0.5 deg in one turn of 13.338 ms, each at
/// its time. Frame: x along beam 90 (the central one), scan plane x-y, beams from -45 to 45 deg. Immutable, hence
/// thread-safe; the tracer must outlive it.
class Lms291 {
 public:
  static constexpr int kBeams = 181;
  struct Settings {
    double period = 13.3381e-3;     ///< s of a turn (Smith et al. 2009)
    double sigma = 5e-3;            ///< m to 20 m; twice that beyond; 0: intensities have no noise either
    double largest_bias = 5e-3;     ///< m; bound of the uniformly distributed constant bias of a device
    double systematic_error = 0.0;  ///< m, added to every range; limit of the data sheet: 0.035
    double step = 1e-3;             ///< m; 0: none, nor of intensities
    double range_max = 32.7;        ///< m: 15 bits of millimetres (1.4 there)
    bool mixes = true;              ///< echoes from the surface beyond a depth edge lengthen the measured range
    bool loses = true;              ///< weak echoes are lost

    /// Without noise, bias, steps, mixed pixels and losses.
    static Settings exact();
  };

  /// `name` ("laser_left") distinguishes the noise of devices of the same seed.
  Lms291(const Tracer& tracer, const urban_nav_core::Pose& T_base_laser, std::uint64_t seed, std::string_view name,
         const Settings& settings);

  /// Returns the scan whose first beam is at `t` (s of the session), the `number`-th of this device, with `stamp`.
  /// Beams without return have infinite range and no intensity. `truth`, if not null: surfaces hit by the beams.
  urban_nav_core::PlanarScan scan(const Motion& motion, double t, urban_nav_core::StampNs stamp, std::uint64_t number,
                                  std::vector<BeamTruth>* truth = nullptr) const;
  double bias() const { return bias_; }  ///< m

 private:
  struct Reading;
  static BeamEchoes echoes(const Snapshot& snapshot, const Packet& packet, const Hits& hits, int first_lane);
  Reading measured(const BeamEchoes& footprint, const Noise& noise, int beam) const;

  const Tracer& tracer_;
  urban_nav_core::Pose T_base_laser_;
  Settings settings_;
  Noise noise_;
  double bias_;
};

}  // namespace urban_nav_sim
