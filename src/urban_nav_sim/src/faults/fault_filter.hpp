// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "camera/lens.hpp"
#include "faults/turned_view.hpp"
#include "urban_nav_sim/fault.hpp"
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

/// Applies faults to measurements, except knocks of lasers and the Ladybug, which OpticalSensors simulates.
/// Deterministic for equal seed and measurements. Not thread-safe.
class FaultFilter {
 public:
  /// `right_lens`: of the right stereo camera, which Knock rotates.
  FaultFilter(std::vector<Fault> faults, std::uint64_t seed, urban_nav_core::StampNs begin,
              const Lens& right_lens = {});

  /// Returns the measurement with faults; nullopt if lost. Measurements must be in the order of `taken`, independent of
  /// their stamps. The truth is not modified.
  std::optional<Measurement> apply(Measurement measurement, urban_nav_core::StampNs taken);

 private:
  /// Streams that freeze independently: a camera of the Ladybug, one of the lasers.
  using Stream = std::pair<Sensor, int>;

  void spoil(const Fault& fault, double t, const Stream& stream, Measurement& measurement);
  void knock(double degrees, Measurement& measurement);

  std::vector<Fault> faults_;
  std::uint64_t seed_, count_ = 0;
  urban_nav_core::StampNs begin_;
  Lens right_lens_;
  std::map<Stream, Measurement> last_good_;
  std::map<double, TurnedView> turns_;  // views of the rotated right camera, by deg
};

}  // namespace urban_nav_sim
